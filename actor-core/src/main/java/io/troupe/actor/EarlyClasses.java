package io.troupe.actor;

import java.util.List;

/**
 * Initialises the classes of this library that a space may need for the first time when memory or stack is short. A
 * class whose initialisation fails there can never be used again: without helper threads, for example, no space of the
 * JVM would report a stall or run a sequential body any more.
 */
final class EarlyClasses {
    /** All classes with an initialiser, but that of the global space. */
    static final List<String> NAMES = List.of(
            "io.troupe.actor.ActorCell$1", // the table of a switch
            "io.troupe.actor.ActorSettings",
            "io.troupe.actor.ActorSettings$Overflow",
            "io.troupe.actor.ActorStoppedException$WithoutMemory",
            "io.troupe.actor.ActorType",
            "io.troupe.actor.BoundedMailbox$Admission",
            "io.troupe.actor.CallObserver$Turn",
            "io.troupe.actor.CleanThreads",
            "io.troupe.actor.Closing",
            "io.troupe.actor.EntryCounter",
            "io.troupe.actor.HandlerTurn",
            "io.troupe.actor.BlockingTaskThreads",
            "io.troupe.actor.IdleStrategy",
            "io.troupe.actor.ObservedCalls",
            "io.troupe.actor.EntryRing",
            "io.troupe.actor.PoolProxyGenerator",
            "io.troupe.actor.ProxyGenerator",
            "io.troupe.actor.ProxyGenerator$Kind",
            "io.troupe.actor.Reports",
            "io.troupe.actor.Reports$Trouble",
            "io.troupe.actor.ReturningCallback",
            "io.troupe.actor.ReturningCallback$Ending",
            "io.troupe.actor.ReturningCallback$Kind",
            "io.troupe.actor.SpaceHome$Contexts",
            "io.troupe.actor.SpaceLog",
            "io.troupe.actor.Supervision",
            "io.troupe.actor.Supervision$Directive",
            "io.troupe.actor.Watchdog",
            "io.troupe.actor.Watchdog$Words",
            "io.troupe.actor.internal.SuspendingCalls$Found",
            "io.troupe.actor.SuspendingRequest",
            "io.troupe.actor.internal.loop.Home",
            "io.troupe.actor.internal.loop.EntryQueue",
            "io.troupe.actor.TimerWheel",
            "io.troupe.actor.TimerWheel$1",
            "io.troupe.actor.Listeners",
            "io.troupe.actor.Promise$Settled",
            "io.troupe.actor.Settleable",
            "io.troupe.actor.Settleable$AlreadySettled",
            "io.troupe.actor.TimeLimitedPromise",
            "io.troupe.actor.Schedule",
            "io.troupe.actor.SystemClock");

    /** Classes of the JDK that the watchdog and helper threads need; those of other versions are not there. */
    private static final List<String> OF_THE_JDK = List.of(
            "java.lang.System$Logger$Level",
            "java.lang.StackTraceElement$HashedModules",
            "java.util.concurrent.LinkedTransferQueue$DualNode",
            "java.util.concurrent.SynchronousQueue$TransferStack",
            "java.util.concurrent.SynchronousQueue$TransferStack$SNode",
            "java.util.concurrent.ThreadPoolExecutor$Worker");

    private EarlyClasses() {}

    /** Initialises them, as far as it can: throws nothing. */
    static void load() {
        OF_THE_JDK.forEach(EarlyClasses::load);
        NAMES.forEach(EarlyClasses::load);
        try {
            Watchdog.isInATurn(List.of(Thread.currentThread().getStackTrace())); // links what it calls
        } catch (Throwable broken) {
            // as below
        }
    }

    private static void load(String name) {
        try {
            Class.forName(name, true, EarlyClasses.class.getClassLoader());
        } catch (Throwable broken) {
            // memory is short already: the first use throws the same error
        }
    }
}
