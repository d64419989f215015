package io.troupe.bench;

import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;

/**
 * The main class of a contender's own JVM. It waits at its standard input for {@code warm <workload> <millis>}, answered by a turn's number of
 * operations, and {@code turn <workload> <operations>}, answered by nanoseconds per operation; the end of the input is the end of the process.
 */
final class ContenderProcess {
    private static final long TURN_NANOS = 30_000_000;
    private static final int MOST_OPERATIONS = 100_000_000;

    private final Contender contender;

    private ContenderProcess(Contender contender) {
        this.contender = contender;
    }

    public static void main(String[] args) throws Exception {
        PrintStream answers = System.out;
        System.setOut(System.err); // what a library prints is no answer
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
            Runtime.getRuntime()
                    .halt(status); // whatever threads a library leaves behind; Kontraktor's timer would keep the JVM
            // alive
        }
    }

    private String answer(String[] command) throws Exception {
        var workload = Workload.named(command[1]);
        int number = Integer.parseInt(command[2]);
        contender.wake();
        try {
            return command[0].equals("warm")
                    ? Integer.toString(warm(workload, number))
                    : Double.toString(turn(workload, number));
        } finally {
            contender.rest();
        }
    }

    /** Runs more and more operations until one run fills a turn, and goes on until the time is over. */
    private int warm(Workload workload, int millis) throws Exception {
        long end = System.nanoTime() + millis * 1_000_000L;
        int operations = 1;
        while (true) {
            long start = System.nanoTime();
            workload.run(contender, operations);
            long now = System.nanoTime();
            if (now >= end) {
                return (int) Math.clamp((double) operations * TURN_NANOS / (now - start), 1, MOST_OPERATIONS);
            }
            operations = (int) Math.clamp((double) operations * TURN_NANOS / (now - start), 1, 2.0 * operations);
        }
    }

    private double turn(Workload workload, int operations) throws Exception {
        workload.run(contender, Math.max(1, operations / 10)); // back to full speed before the clock starts
        return (double) workload.run(contender, operations) / operations;
    }
}
