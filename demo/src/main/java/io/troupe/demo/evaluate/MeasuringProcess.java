package io.troupe.demo.evaluate;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;

/**
 * A child JVM that runs measurements with a configured number of processors.
 *
 * <p><b>Errors.</b> {@link IOException} if the JVM cannot be started, fails, exits, or has a different number of
 * processors. Its log output goes to a file.
 */
final class MeasuringProcess implements AutoCloseable {
    private final int cores;
    private final Path log;
    private final Process process;
    private final PrintWriter jobs;
    private final BufferedReader answers;

    private MeasuringProcess(int cores, Path log, Process process) {
        this.cores = cores;
        this.log = log;
        this.process = process;
        this.jobs = new PrintWriter(process.outputWriter(StandardCharsets.UTF_8));
        this.answers = process.inputReader(StandardCharsets.UTF_8);
    }

    static MeasuringProcess start(int cores, Path world, Path log) throws IOException {
        var java = Path.of(System.getProperty("java.home"), "bin", "java");
        var process = new ProcessBuilder(
                        java.toString(),
                        "-XX:ActiveProcessorCount=" + cores,
                        "-Xms256m",
                        "-Xmx256m",
                        "-cp",
                        System.getProperty("java.class.path"),
                        MeasuringMain.class.getName(),
                        world.toString())
                .redirectError(ProcessBuilder.Redirect.appendTo(log.toFile()))
                .start();
        return new MeasuringProcess(cores, log, process);
    }

    int cores() {
        return cores;
    }

    Result measure(Job job) throws IOException {
        jobs.println(job.line());
        jobs.flush();
        var result = new Result.Builder();
        for (String line = answers.readLine(); line != null; line = answers.readLine()) {
            if (line.startsWith(MeasuringMain.END)) {
                checkProcessors(line.substring(MeasuringMain.END.length()));
                return result.build();
            }
            if (line.startsWith(MeasuringMain.ERROR)) {
                throw new IOException(job.title() + ": " + line.substring(MeasuringMain.ERROR.length()));
            }
            var value = Result.Value.parse(line);
            result.add(value.subject(), value.quantity(), value.value());
        }
        throw new IOException(job.title() + ": the JVM that measures (told " + CoreMeasurements.cores(cores)
                + ") has ended: " + status() + ", see " + log);
    }

    private void checkProcessors(String had) throws IOException {
        if (!had.equals(Integer.toString(cores))) {
            throw new IOException("the JVM that measures says it has " + had + " processors, expected " + cores
                    + " as it was told, see " + log);
        }
    }

    private String status() {
        try {
            return "exit status " + process.waitFor();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return "interrupted while waiting for it";
        }
    }

    /** Kills the process in any state. May be called by any thread. */
    void end() {
        process.destroy();
    }

    @Override
    public void close() {
        jobs.close();
        process.destroy();
    }

    /**
     * Main class of the measuring JVM. It reads jobs from standard input, one per line. It answers each job with its
     * values and a line of {@value #END} and the number of available processors, or with one line that starts with
     * {@value #ERROR}. It exits at the end of its input.
     */
    static final class MeasuringMain {
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
}
