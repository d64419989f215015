package io.troupe.faults.history;

/** One thing that a process of a run has written down. Components are texts, numbers, booleans and enums. */
public sealed interface Event {
    /** How a call is made, and what it asks for. */
    enum CallKind {
        /** The handler answers at once. */
        SHORT,
        /** The handler answers later, perhaps after the limit. */
        LONG,
        /** Cancelled by its caller while it is under way. */
        CANCELLED,
        /** Without an answer. */
        ONE_WAY
    }

    /** Why a value that was sent was not delivered. */
    enum Reason {
        /** Reported by the subscriber: values of the publisher have not arrived. */
        MISSED,
        /** The queue of the subscriber was full. */
        DROPPED,
        /** Older than its topic permits. */
        STALE,
        /** A newer value has replaced it, on a topic that keeps only the latest. */
        REPLACED
    }

    /** Something that is done to the application under test. */
    enum FaultKind {
        KILL_PROVIDER,
        KILL_BROKER,
        KILL_SERVER,
        FREEZE_NODE,
        FREEZE_SERVER,
        CUT_NODE,
        CUT_SERVER,
        SLOW_SUBSCRIBER,
        FLOOD,
        NAME_TAKEN,
        OVERSIZED,
        UNREADABLE
    }

    /** Something that is done to robot services. A spare provider is one that drives no robot. */
    enum DriverFaultKind {
        KILL_DRIVER,
        KILL_SPARE,
        KILL_ALL_PROVIDERS,
        KILL_ARBITRATOR,
        KILL_SERVER,
        FREEZE_DRIVER,
        FREEZE_SPARE,
        FREEZE_ARBITRATOR,
        FREEZE_SERVER,
        CUT_DRIVER,
        CUT_SPARE,
        CUT_ARBITRATOR,
        CUT_DRIVER_FROM_ROBOTS
    }

    // ---- written by nodes

    /** A node has connected to the bus and is ready. */
    record Opened(String node) implements Event {}

    /** A node has settled its calls, and publishes nothing more; the marks of its topics have been sent. */
    record Closed() implements Event {}

    /**
     * A call is made now.
     *
     * @param limitMillis it has to be settled within this time
     * @param executionMillis the limit that travels with it: after that no handler may begin it
     */
    record Called(String call, String target, CallKind kind, long limitMillis, long executionMillis) implements Event {}

    /**
     * A call was settled.
     *
     * @param answered true if the answer of the handler has arrived
     * @param mayBeSent false if by the error no handler has executed the call or will
     */
    record Settled(String call, boolean answered, boolean mayBeSent, String outcome) implements Event {}

    /** A handler begins to execute a call. */
    record Executed(String call) implements Event {}

    /** A call with a callback is made. */
    record StreamOpened(String stream, String target, long items) implements Event {}

    /** A callback was passed an item. */
    record StreamItem(String stream, long number) implements Event {}

    /** A stream has ended for its reader. */
    record StreamEnded(String stream, boolean completely, String outcome) implements Event {}

    /** The last of the values that a publisher has just published on a topic; they are numbered from 1. */
    record Published(String topic, long last) implements Event {}

    /**
     * Values were delivered to the subscriber of this node.
     *
     * @param last the number of the last one
     * @param count how many in a row
     * @param ageMicros of the last one, since it was published
     */
    record Delivered(String topic, String publisher, long last, long count, long ageMicros) implements Event {}

    /** The publisher was notified that a value was not sent: it has no connection, or the value is too large. */
    record Unsent(String topic, long number) implements Event {}

    /** The first value of a publisher has arrived at a subscriber. */
    record FirstArrival(String topic, String publisher, long number) implements Event {}

    /** The subscriber was notified that values were not delivered. */
    record Lost(String topic, String publisher, Reason reason, long count) implements Event {}

    /** Bytes that are no message were reported. */
    record Unreadable(String what) implements Event {}

    /** The process did not run for a while before this moment. */
    record Paused(long nanos) implements Event {}

    record Connected() implements Event {}

    /** The broker of the process has reported an event: for readers of a history, no rule uses it. */
    record BrokerReported(String event) implements Event {}

    record Disconnected() implements Event {}

    /** The heap in use after a collection. */
    record Memory(long bytes) implements Event {}

    // ---- about robots

    /** The speed of a robot after a tick of the world. */
    record Moved(long worldMicros, int robot, double turnRadps) implements Event {}

    /** A driver sends a speed to a robot; it never sends one twice. */
    record Sent(int robot, double turnRadps) implements Event {}

    /**
     * A provider of robot services sends a speed to a robot.
     *
     * @param drive counts the services of this process that have driven the robot
     */
    record Commanded(int robot, int drive, String service, boolean moving) implements Event {}

    /** A provider stops a service, whose lease is over. */
    record LeaseLost(int robot, int drive) implements Event {}

    /** Whether a robot moves after a tick of the world. */
    record Rolled(long worldMicros, int robot, boolean moving) implements Event {}

    /** An arbitrator is connected, and begins to look for providers. */
    record ArbitratorStarted() implements Event {}

    /** The arbitrator was notified that a robot has lost its driver. */
    record DriverLost(int robot, String why) implements Event {}

    /** The arbitrator was notified that a robot has a driver again. */
    record DrivenAgain(int robot) implements Event {}

    /** An arbitrator has ended with an error. */
    record ArbitratorEnded(String type, String message) implements Event {}

    // ---- written by the suite

    /** @param target the hosts, separated by commas */
    record DriverFaultBegan(long number, DriverFaultKind kind, String target, String details) implements Event {}

    /** What a fault breaks is broken now; {@link FaultEnded} follows when it is repaired. */
    record Broken(long number) implements Event {}

    record FaultBegan(long number, FaultKind kind, String target, String details) implements Event {}

    record FaultEnded(long number) implements Event {}

    /** A process was found in another state than it has to be: it ended, or a name was given twice. */
    record Surprise(String what) implements Event {}
}
