/**
 * Typed actors and promises on one thread.
 *
 * <p>A module with actor types writes {@code requires io.troupe.actor;} and {@code opens} the package of the types.
 */
@SuppressWarnings("module") // the sister modules are compiled after this one
module io.troupe.actor {
    requires static transitive org.jspecify;
    requires java.management;
    requires jdk.jfr;
    requires jdk.unsupported; // sun.reflect.ReflectionFactory, for the proxies of class actors
    requires org.objectweb.asm;

    exports io.troupe.actor;
    exports io.troupe.actor.testkit;
    exports io.troupe.actor.internal to // and to the modules of actor types, when their proxies are generated
            io.troupe.actor.kotlin,
            io.troupe.service,
            io.troupe.services;
    exports io.troupe.actor.internal.loop to
            io.troupe.actor.kotlin,
            io.troupe.service;

    uses io.troupe.actor.internal.SuspendingCalls;
}
