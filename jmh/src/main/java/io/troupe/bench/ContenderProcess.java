package io.troupe.bench;

import io.troupe.tools.MeasuringJvm;
import io.troupe.tools.SampleStatistics;
import io.troupe.tools.UsedHeap;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

/** A contender in a separate JVM. Between two requests that process waits, and uses no processor. */
final class ContenderProcess implements AutoCloseable {
    private static final Duration PATIENCE = Duration.ofSeconds(60);

    private final Contenders contender;
    private final MeasuringJvm jvm;

    /** Starts the contender, and waits until it is ready. */
    ContenderProcess(Contenders contender) throws IOException {
        this.contender = contender;
        this.jvm = MeasuringJvm.running(Child.class, contender.label())
                .withOptions(
                        "-Xmx512m",
                        "-XX:+UseG1GC",
                        "-Dslf4j.internal.verbosity=ERROR") // Pekko is used without a logger on purpose
                .withLimit(PATIENCE)
                .start();
        try {
            ask("ready");
        } catch (IOException failure) {
            jvm.close();
            throw failure;
        }
    }

    Contenders contender() {
        return contender;
    }

    String name() {
        return contender.label();
    }

    /** Warms up; returns how many operations fill a turn. */
    int warm(Workload workload, int millis) throws IOException {
        return Integer.parseInt(ask("warm " + workload.label() + " " + millis));
    }

    TurnResult turn(Workload workload, int operations) throws IOException {
        return TurnResult.parse(ask("turn " + workload.label() + " " + operations));
    }

    /** The bytes of the heap that an actor retains. */
    double retainedBytes() throws IOException {
        return Double.parseDouble(ask("retained"));
    }

    private String ask(String request) throws IOException {
        return jvm.ask(request, name() + ", " + request).getFirst();
    }

    /** Ends the process, even one that hangs. */
    @Override
    public void close() {
        jvm.close();
    }

    /**
     * The main class of a contender's JVM. It answers {@code ready}; {@code warm <workload> <millis>} by a turn's
     * number of operations; {@code turn <workload> <operations>} by a {@link TurnResult}; and {@code retained} by bytes
     * per actor.
     */
    static final class Child {
        private static final long TURN_NANOS = 30_000_000;
        private static final int MOST_OPERATIONS = 100_000_000;

        private final Contender contender;
        private final Subject subject;

        private Child(Contender contender) {
            this.contender = contender;
            subject = new Subject(contender);
        }

        public static void main(String[] args) {
            int status = 1;
            try {
                MeasuringJvm.serve(() -> {
                    var child = new Child(Contenders.named(args[0]).start());
                    child.contender.rest();
                    return child::answer;
                });
                status = 0;
            } catch (Throwable failure) {
                failure.printStackTrace();
            } finally {
                // ends threads that a library leaves behind: Kontraktor's timer would keep the JVM alive
                Runtime.getRuntime().halt(status);
            }
        }

        private List<String> answer(String request) throws Exception {
            String[] command = request.split(" ");
            if (command[0].equals("ready")) {
                return List.of(request);
            }
            contender.wake();
            try {
                return List.of(
                        switch (command[0]) {
                            case "warm" ->
                                Integer.toString(warm(Workload.named(command[1]), Integer.parseInt(command[2])));
                            case "turn" ->
                                turn(Workload.named(command[1]), Integer.parseInt(command[2]))
                                        .line();
                            case "retained" -> Double.toString(RetainedHeap.bytesPerActor(contender));
                            default ->
                                throw new IllegalArgumentException(
                                        "a command is " + command[0] + ", expected ready, warm, turn or retained");
                        });
            } catch (Exception failure) {
                failure.printStackTrace(); // the answer has only its first line
                throw failure;
            } finally {
                contender.rest();
            }
        }

        /** Runs growing numbers of operations until one run fills a turn, and repeats that until the time is over. */
        private int warm(Workload workload, int millis) throws Exception {
            long end = System.nanoTime() + millis * 1_000_000L;
            int operations = workload.whole(1);
            while (true) {
                long start = System.nanoTime();
                workload.run(subject, operations);
                long now = System.nanoTime();
                if (now >= end) {
                    return (int) Math.clamp((double) operations * TURN_NANOS / (now - start), 1, MOST_OPERATIONS);
                }
                operations = workload.whole(
                        (int) Math.clamp((double) operations * TURN_NANOS / (now - start), 1, 2.0 * operations));
            }
        }

        private TurnResult turn(Workload workload, int operations) throws Exception {
            workload.run(subject, Math.max(1, operations / 10)); // back to full speed before the clock starts
            return workload.run(subject, operations);
        }
    }

    /** Measures the heap that an idle actor retains after it has handled one message. */
    static final class RetainedHeap {
        static final int ACTORS = 2_000;
        private static final int TRIALS = 5;
        /** Lets the contender drop what it keeps until a collection or until the end of its last task. */
        private static final Duration PAUSE = Duration.ofMillis(20);

        private RetainedHeap() {}

        /**
         * Bytes per actor, the median of some trials. Small allocations of the contender meanwhile are divided by 2,000
         * actors.
         */
        static double bytesPerActor(Contender contender) throws Exception {
            return bytesPerActor(() -> contender.create(ACTORS), contender::clear);
        }

        interface Action {
            void run() throws Exception;
        }

        /**
         * Measures what {@code create}, which makes {@link #ACTORS} objects, adds to the heap; {@code clear} drops
         * them.
         */
        static double bytesPerActor(Action create, Action clear) throws Exception {
            List<Double> trials = new ArrayList<>();
            for (int i = 0; i < TRIALS; i++) {
                long before = UsedHeap.bytes(PAUSE);
                create.run();
                trials.add((double) (UsedHeap.bytes(PAUSE) - before) / ACTORS);
                clear.run();
            }
            return SampleStatistics.of(trials).median();
        }
    }
}
