/** Actors with suspend functions, coroutines on an actor space, and flows, for Kotlin. */
module io.troupe.actor.kotlin {
    requires transitive io.troupe.actor;
    requires static io.troupe.service; // only for users of actors as services
    requires transitive kotlin.stdlib;
    requires transitive kotlinx.coroutines.core;

    exports io.troupe.actor.kotlin;

    provides io.troupe.actor.internal.SuspendingCalls with // also in META-INF/services, for the class path
            io.troupe.actor.kotlin.Suspending;
}
