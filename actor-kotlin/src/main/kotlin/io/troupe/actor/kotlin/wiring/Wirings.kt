@file:JvmName("Wirings")

package io.troupe.actor.kotlin.wiring

import io.troupe.petri.wiring.Branch
import io.troupe.petri.wiring.Protocol
import io.troupe.petri.wiring.ProtocolBuilder
import io.troupe.petri.wiring.Wiring
import io.troupe.petri.wiring.WiringBuilder

/** Marks the receivers of declarations: an inner one does not reach the functions of an outer one. */
@DslMarker
@Retention(AnnotationRetention.BINARY)
public annotation class WiringDsl

/**
 * Builds a wiring: components, the calls between them, and by the functions of the builder what else it has.
 *
 * ```
 * val pictures = wiring("pictures") {
 *     component("camera") {
 *         state("idle") {
 *             does("take a picture", then = "holding")
 *             provides("pause", then = "paused")
 *         }
 *         state("holding") { requests("store.keep", then = "idle") }
 *         state("paused") { does("wake up", then = "idle") }
 *     }
 *     component("store") {
 *         state("open") { provides("keep", then = "checking") }
 *         state("checking") {
 *             does("find room", then = "open")
 *             does("find none", then = "full")
 *         }
 *         state("full") { requests("camera.pause", then = "open") }
 *     }
 * }
 * ```
 *
 * @throws IllegalArgumentException if a name or a call does not fit; the message suggests the nearest one
 */
public fun wiring(name: String, declare: WiringBuilder.() -> Unit): Wiring = Wiring.of(name).apply(declare).build()

/** Adds a component and declares what it does; its name is also that of its protocol. */
public fun WiringBuilder.component(name: String, declare: StatesScope.() -> Unit) {
    component(protocol(name, declare))
}

/**
 * Declares what several components do: the argument of `components`, for example.
 *
 * ```
 * val client = protocol("client") {
 *     state("idle") { does("look", then = "informed") }
 *     state("informed") {
 *         requests("planner.plan", then = "idle")
 *         stops()
 *     }
 * }
 * ```
 *
 * @throws IllegalArgumentException for a step to an undeclared state, an unreachable state, a call offered twice
 */
public fun protocol(name: String, declare: StatesScope.() -> Unit): Protocol {
    val builder = Protocol.of(name)
    StatesScope(builder).declare()
    return builder.build()
}

/** The states of a protocol. */
@WiringDsl
public class StatesScope internal constructor(private val builder: ProtocolBuilder) {
    /** Declares a state and the ways out of it: one way is the next step, several are a choice. */
    public fun state(name: String, declare: BranchesScope.() -> Unit) {
        val branches = BranchesScope().apply(declare).branches
        builder.`in`(name, *branches.toTypedArray())
    }

    /** Lets the component fail in every other state; this one follows. */
    public fun failsTo(state: String) {
        builder.failsTo(state)
    }
}

/** The ways out of a state. */
@WiringDsl
public class BranchesScope internal constructor() {
    internal val branches = mutableListOf<Branch>()

    /** A private step; the label describes it in counterexamples. */
    public fun does(label: String, then: String) {
        branches += Protocol.does(label).then(then)
    }

    /**
     * A call, written `component.call`; the component waits for its answer.
     *
     * @param onTimeout the state after a time-out, which may come at any moment before the answer
     * @param onRejection the state after a rejection
     */
    public fun requests(call: String, then: String, onTimeout: String? = null, onRejection: String? = null) {
        var branch = Protocol.requests(call).then(then)
        onTimeout?.let { branch = branch.orTimeout(it) }
        onRejection?.let { branch = branch.orRejected(it) }
        branches += branch
    }

    /** A call that other components may make while the component is in this state. */
    public fun provides(call: String, then: String) {
        branches += Protocol.provides(call).then(then)
    }

    /** A call that the component rejects while it is in this state. */
    public fun rejects(call: String, then: String) {
        branches += Protocol.rejects(call).then(then)
    }

    /** A call, written `component.call`, whose answer the component takes later, in a state that is [answered]. */
    public fun asks(call: String, then: String) {
        branches += Protocol.asks(call).then(then)
    }

    /** Takes the answer to a question; of a stream, its next item. */
    public fun answered(call: String, then: String) {
        branches += Protocol.answered(call).then(then)
    }

    /** Takes the rejection of a question. */
    public fun rejected(call: String, then: String) {
        branches += Protocol.rejected(call).then(then)
    }

    /** Gives up a question, and closes its stream. */
    public fun cancels(call: String, then: String) {
        branches += Protocol.cancels(call).then(then)
    }

    /** A call that stays open as a stream. */
    public fun streams(call: String, then: String) {
        branches += Protocol.streams(call).then(then)
    }

    /** Puts an item into the open stream of a call. */
    public fun emits(call: String, then: String) {
        branches += Protocol.emits(call).then(then)
    }

    /** Ends the open stream of a call. */
    public fun finishes(call: String, then: String) {
        branches += Protocol.finishes(call).then(then)
    }

    /** Takes the end of a stream, after all of its items. */
    public fun finished(call: String, then: String) {
        branches += Protocol.finished(call).then(then)
    }

    /**
     * A one-way message, written `component.message`.
     *
     * @param onRejection the state after a message that a full mailbox rejects
     */
    public fun sends(message: String, then: String, onRejection: String? = null) {
        val branch = Protocol.sends(message).then(then)
        branches += if (onRejection == null) branch else branch.orRejected(onRejection)
    }

    /** Takes the oldest message of the mailbox if it is this one. */
    public fun receives(message: String, then: String) {
        branches += Protocol.receives(message).then(then)
    }

    /** Waits for a unit of a resource and holds it from then on. */
    public fun acquires(resource: String, then: String) {
        branches += Protocol.acquires(resource).then(then)
    }

    /** Gives a unit of a resource back. */
    public fun releases(resource: String, then: String) {
        branches += Protocol.releases(resource).then(then)
    }

    /** Allows the component to stop here: it goes back to its first state. */
    public fun stops() {
        branches += Protocol.stops()
    }
}
