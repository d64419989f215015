package io.troupe.bench;

import java.util.Arrays;
import picocli.CommandLine.ITypeConverter;

/**
 * The workloads: one operation is one message, one hop, one answer or one actor. {@code tellOfMany} comes last because
 * its many types would spoil the compiled code of all others.
 */
enum Workload {
    TELL("tell", 100_000, Subject::tell),
    TELL_FROM_FOUR("tellFromFour", 100_000, Subject::tellFromFour),
    PING_PONG("pingPong", 1_000_000, (subject, hops) -> subject.contender().pingPong(hops)),
    ASK_PIPELINED("askPipelined", 20_000, (subject, asks) -> subject.contender().askPipelined(asks)),
    ASK_CHAIN("askChain", 1_000_000, (subject, asks) -> subject.contender().askChain(asks)),
    ASK_ONCE("askOnce", 1_000_000, (subject, asks) -> subject.contender().askOnce(asks)),
    ASK_AFTER_SILENCE(
            "askAfterSilence", 1, (subject, asks) -> subject.contender().askOnce(asks)),
    CREATE("create", 2_000, (subject, actors) -> subject.contender().create(actors)),
    TELL_OF_MANY("tellOfMany", 100_000, Subject::tellOfMany);

    private static final long SILENCE_MILLIS = 5;

    private final String label;
    private final int batch;
    private final Body body;

    Workload(String label, int batch, Body body) {
        this.label = label;
        this.batch = batch;
        this.body = body;
    }

    private interface Body {
        void run(Subject subject, int operations) throws Exception;
    }

    String label() {
        return label;
    }

    /** False if the operating system decides the result: how soon a sleeping thread runs. */
    boolean isRanked() {
        return this != ASK_ONCE && this != ASK_AFTER_SILENCE;
    }

    static Workload named(String label) {
        for (Workload each : values()) {
            if (each.label.equals(label)) {
                return each;
            }
        }
        throw BenchmarkCommand.unknown(
                label, Arrays.stream(values()).map(Workload::label).toList());
    }

    /** Converts labels. */
    static final class Converter implements ITypeConverter<Workload> {
        @Override
        public Workload convert(String label) {
            return named(label);
        }
    }

    @Override
    public String toString() {
        return label;
    }

    /** The next number of operations that the workload can run with each message type equally often. */
    int whole(int operations) {
        int grain = this == TELL_OF_MANY ? Families.TYPES : 1;
        return Math.ceilDiv(operations, grain) * grain;
    }

    /**
     * Runs and measures {@code operations} operations, in batches that bound the queue. Pauses and clearing up are not
     * measured.
     */
    TurnResult run(Subject subject, int operations) throws Exception {
        long nanos = 0;
        long bytes = 0;
        int whole = whole(operations);
        for (int left = whole; left > 0; left -= batch) {
            if (this == ASK_AFTER_SILENCE) {
                Thread.sleep(SILENCE_MILLIS);
            }
            long allocated = TurnResult.allocatedBytes();
            long start = System.nanoTime();
            body.run(subject, Math.min(left, batch));
            nanos += System.nanoTime() - start;
            bytes += TurnResult.allocatedBytes() - allocated;
            subject.contender().clear();
        }
        return new TurnResult((double) nanos / whole, (double) bytes / whole);
    }
}
