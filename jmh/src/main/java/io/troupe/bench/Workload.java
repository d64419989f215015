package io.troupe.bench;

/** What is measured: one operation is one message, one hop, one answer or one actor. */
enum Workload {
    TELL("tell", 100_000, Contender::tell),
    PING_PONG("pingPong", 1_000_000, Contender::pingPong),
    ASK_PIPELINED("askPipelined", 20_000, Contender::askPipelined),
    ASK_CHAIN("askChain", 1_000_000, Contender::askChain),
    ASK_ONCE("askOnce", 1_000_000, Contender::askOnce),
    ASK_AFTER_SILENCE("askAfterSilence", 1, Contender::askOnce),
    CREATE("create", 2_000, Contender::create);

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
        void run(Contender contender, int operations) throws Exception;
    }

    String label() {
        return label;
    }

    static Workload named(String label) {
        for (Workload each : values()) {
            if (each.label.equals(label)) {
                return each;
            }
        }
        throw new IllegalArgumentException("no workload " + label);
    }

    /** Runs so many operations, in batches that bound what is queued, and gives the nanoseconds without pauses and clearing up. */
    long run(Contender contender, int operations) throws Exception {
        long nanos = 0;
        for (int left = operations; left > 0; left -= batch) {
            if (this == ASK_AFTER_SILENCE) {
                Thread.sleep(SILENCE_MILLIS);
            }
            long start = System.nanoTime();
            body.run(contender, Math.min(left, batch));
            nanos += System.nanoTime() - start;
            contender.clear();
        }
        return nanos;
    }
}
