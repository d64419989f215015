package io.troupe.bench;

import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;

/**
 * The main class of a contender's JVM. It reads requests from standard input: {@code warm <workload> <millis>},
 * answered by a turn's number of operations; {@code turn <workload> <operations>}, answered by a {@link TurnResult};
 * and {@code retained}, answered by bytes per actor. It exits at the end of its input.
 */
final class ContenderProcess {
    private static final long TURN_NANOS = 30_000_000;
    private static final int MOST_OPERATIONS = 100_000_000;

    private final Contender contender;
    private final Subject subject;

    private ContenderProcess(Contender contender) {
        this.contender = contender;
        subject = new Subject(contender);
    }

    public static void main(String[] args) throws Exception {
        PrintStream answers = System.out;
        System.setOut(System.err); // output of libraries must not mix with the answers
        int status = 1;
        try (var commands = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8))) {
            var process = new ContenderProcess(Contenders.named(args[0]).start());
            process.contender.rest();
            answers.println("ready");
            for (String line = commands.readLine(); line != null; line = commands.readLine()) {
                answers.println(process.answer(line.split(" ")));
            }
            status = 0;
        } catch (Throwable failure) {
            failure.printStackTrace();
        } finally {
            // ends threads that a library leaves behind: Kontraktor's timer would keep the JVM alive
            Runtime.getRuntime().halt(status);
        }
    }

    private String answer(String[] command) throws Exception {
        contender.wake();
        try {
            return switch (command[0]) {
                case "warm" -> Integer.toString(warm(Workload.named(command[1]), Integer.parseInt(command[2])));
                case "turn" ->
                    turn(Workload.named(command[1]), Integer.parseInt(command[2]))
                            .line();
                case "retained" -> Double.toString(RetainedHeap.bytesPerActor(contender));
                default ->
                    throw new IllegalArgumentException(
                            "a command is " + command[0] + ", expected warm, turn or retained");
            };
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
