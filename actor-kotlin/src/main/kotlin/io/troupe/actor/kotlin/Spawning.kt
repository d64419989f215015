@file:JvmName("Spawning")

package io.troupe.actor.kotlin

import io.troupe.actor.ActorSettings
import io.troupe.actor.ActorSpace
import io.troupe.actor.testkit.TestSpace

/**
 * Creates an actor of any kind: its type is an interface, or an open class that extends `Actor`, and its functions
 * suspend, return a `Promise`, or return `Unit` (a one-way message).
 *
 * ```
 * interface Greeter {
 *     suspend fun greet(name: String): String
 * }
 *
 * val greeter = space.spawn<Greeter> { PoliteGreeter() }
 * ```
 *
 * A suspend function is a request: its caller suspends until the actor has answered, and an exception of the actor
 * reaches the caller unwrapped. In the actor it runs as a coroutine on the space's thread. While it is suspended, the
 * actor handles other messages, as between two listeners of a promise. If the caller is cancelled, so is that
 * coroutine; if the actor stops or restarts, the caller gets an `ActorStoppedException` and the coroutine is cancelled.
 *
 * Any thread may spawn an actor, and call it. Write the type, `spawn<Greeter>`: without it the compiler takes the class
 * of the implementation.
 *
 * @param factory creates the implementation, on the space's thread, before the first message
 * @throws io.troupe.actor.ActorTypeException if the type has a function that cannot be a message
 */
public inline fun <reified A : Any> ActorSpace.spawn(
    settings: ActorSettings = ActorSettings.defaults(),
    noinline factory: () -> A,
): A = spawn(A::class.java, factory, settings)

/**
 * Creates an actor in a test and starts it; see [ActorSpace.spawn].
 *
 * ```
 * val timer = test.spawn<EggTimer> { ThreeMinutes() }
 * ```
 */
public inline fun <reified A : Any> TestSpace.spawn(
    settings: ActorSettings = ActorSettings.defaults(),
    noinline factory: () -> A,
): A = spawn(A::class.java, factory, settings)
