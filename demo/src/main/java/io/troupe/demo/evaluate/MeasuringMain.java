package io.troupe.demo.evaluate;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;

/**
 * Main class of the measuring JVM. It reads jobs from standard input, one per line. It answers each job with its values
 * and a line of {@value #END} and the number of available processors, or with one line that starts with
 * {@value #ERROR}. It exits at the end of its input.
 */
final class MeasuringMain {
    static final String END = "end ";
    static final String ERROR = "error ";

    private MeasuringMain() {}

    /** @param arguments the world file */
    public static void main(String[] arguments) throws IOException, InterruptedException {
        PrintStream out = System.out;
        System.setOut(System.err); // keeps other output out of the protocol
        var world = PaperWorld.read(Path.of(arguments[0]));
        var run = new JobRunner(world.scenario(), world.port());
        var in = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        for (String line = in.readLine(); line != null; line = in.readLine()) {
            answer(run, Job.parse(line), out);
        }
    }

    private static void answer(JobRunner run, Job job, PrintStream out) throws InterruptedException {
        try {
            run.measure(job).values().forEach(value -> out.println(value.line()));
            out.println(END + Runtime.getRuntime().availableProcessors());
        } catch (RuntimeException failed) {
            out.println(ERROR + failed.toString().replaceAll("\\R", " "));
        }
        out.flush();
    }
}
