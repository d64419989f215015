@file:JvmName("Services")

package io.troupe.actor.kotlin

import io.troupe.actor.ActorSpace
import io.troupe.actor.Promise
import io.troupe.broker.ActorConnection
import io.troupe.broker.ActorServices
import io.troupe.broker.ConnectionSettings
import io.troupe.broker.Need
import io.troupe.broker.ServiceRecord

/**
 * Publishes an actor that the broker spawns on demand; it needs the module actor-service. Suspend functions are called
 * like functions that return a `Promise`, in this process and from other hosts.
 *
 * ```
 * services.publish<Thermometer>(space, "thermometer") { ThermometerActor() }
 * ```
 *
 * Any thread may call this. The promise has the broker's record of the service, or its reason for a refusal.
 *
 * @param space where it runs
 * @param factory creates the actor, on its space, at each start
 * @throws IllegalArgumentException if there is a bus, and a function cannot be called from other hosts; the message
 *     names it, the parameter and the reason
 */
public inline fun <reified A : Any> ActorServices.publish(
    space: ActorSpace,
    service: String,
    capabilities: List<String> = emptyList(),
    noinline factory: () -> A,
): Promise<ServiceRecord> = publish(space, A::class.java, service, capabilities, factory)

/**
 * Connects to the current provider of a service, and after a failover or replacement to the next one.
 *
 * ```
 * val thermometer = services.connect<Thermometer>(Need.ofService("guest", "thermometer")).actor()
 * ```
 *
 * Any thread may call this, and its actor. What a connection does without a provider, and how its calls fail, is the
 * same as in Java.
 *
 * @throws IllegalArgumentException if the type is a class, or has a function that cannot be a message
 */
public inline fun <reified A : Any> ActorServices.connect(
    need: Need,
    settings: ConnectionSettings = ConnectionSettings.defaults(),
): ActorConnection<A> = connect(A::class.java, need, settings)
