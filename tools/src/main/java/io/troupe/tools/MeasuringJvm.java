package io.troupe.tools;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.FutureTask;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;

/**
 * A child JVM that measures. Between two requests it waits, and uses no processor.
 *
 * <pre>{@code
 * // the parent
 * try (var jvm = MeasuringJvm.running(Child.class, "tell").withOptions("-Xmx512m").start()) {
 *     double nanos = Double.parseDouble(jvm.ask("turn 1000").getFirst());
 * }
 *
 * // the main method of Child
 * MeasuringJvm.serve(() -> {
 *     var workload = new Workload(arguments[0]);
 *     return request -> List.of(workload.run(request));
 * });
 * }</pre>
 *
 * <p><b>Role.</b> Starts the JVM, sends requests and reads the answers, and answers them in the child. A request is a
 * line of text, an answer any number of lines. The child has the class path of its parent, unless given another one.
 *
 * <p><b>Threads.</b> Requests come from one thread at a time. {@link #end} and {@link #close} may be called by any.
 *
 * <p><b>Errors.</b> {@link IOException} if the JVM cannot be started, ends, answers too late, or has a different number
 * of processors than its settings, and if the request failed there; then the next request may succeed. A JVM that
 * answers too late is killed, so that its late answer is not taken for the next one's: all later requests fail.
 */
public final class MeasuringJvm implements AutoCloseable {
    /** First word of an answer: the numbers of lines and of processors follow. */
    private static final String DONE = "done";
    /** First word of an answer to a request that failed: the reason follows. */
    private static final String FAILED = "failed";

    private static final int SECONDS_TO_END = 5;

    private final Settings settings;
    private final Process process;
    private final PrintWriter requests;
    private final BufferedReader answers;

    private MeasuringJvm(Settings settings, Process process) {
        this.settings = settings;
        this.process = process;
        this.requests = new PrintWriter(process.outputWriter(StandardCharsets.UTF_8));
        this.answers = process.inputReader(StandardCharsets.UTF_8);
    }

    /**
     * What to start.
     *
     * @param main its main method calls {@link MeasuringJvm#serve}
     * @param options of the JVM
     * @param processors the number that the JVM is configured to have; null for those of the machine
     * @param log the file to which its standard error is appended; null for the standard error of this program
     * @param limit the longest time for an answer, after which the JVM is killed; null for no limit
     * @param classPath null for that of the parent
     */
    public record Settings(
            Class<?> main,
            List<String> arguments,
            List<String> options,
            @Nullable Integer processors,
            @Nullable Path log,
            @Nullable Duration limit,
            @Nullable String classPath) {
        public Settings {
            arguments = List.copyOf(arguments);
            options = List.copyOf(options);
        }

        public Settings withOptions(String... added) {
            return new Settings(main, arguments, List.of(added), processors, log, limit, classPath);
        }

        public Settings withProcessors(int count) {
            return new Settings(main, arguments, options, count, log, limit, classPath);
        }

        public Settings withLog(Path file) {
            return new Settings(main, arguments, options, processors, file, limit, classPath);
        }

        public Settings withLimit(Duration longest) {
            return new Settings(main, arguments, options, processors, log, longest, classPath);
        }

        public Settings withClassPath(String path) {
            return new Settings(main, arguments, options, processors, log, limit, path);
        }

        public MeasuringJvm start() throws IOException {
            var command = new ArrayList<String>();
            command.add(Path.of(System.getProperty("java.home"), "bin", "java").toString());
            if (processors != null) {
                command.add("-XX:ActiveProcessorCount=" + processors);
            }
            command.addAll(options);
            command.addAll(List.of(
                    "-cp", classPath == null ? System.getProperty("java.class.path") : classPath, main.getName()));
            command.addAll(arguments);
            var builder = new ProcessBuilder(command);
            builder.redirectError(
                    log == null ? ProcessBuilder.Redirect.INHERIT : ProcessBuilder.Redirect.appendTo(log.toFile()));
            return new MeasuringJvm(this, builder.start());
        }

        /** The JVM as error messages name it. */
        private String name() {
            return processors == null
                    ? "the JVM that measures"
                    : "the JVM that measures (told " + processors + (processors == 1 ? " core)" : " cores)");
        }

        private String seeLog() {
            return log == null ? "" : ", see " + log;
        }
    }

    /** Settings without JVM options, a number of processors, a log or a limit. */
    public static Settings running(Class<?> main, String... arguments) {
        return new Settings(main, List.of(arguments), List.of(), null, null, null, null);
    }

    /** Sends a request and waits for its answer; error messages quote the request. */
    public List<String> ask(String request) throws IOException {
        return ask(request, request);
    }

    /**
     * Sends a request and waits for its answer.
     *
     * @param title names the request in error messages
     */
    public List<String> ask(String request, String title) throws IOException {
        requests.println(request);
        requests.flush();
        return settings.limit() == null ? answer(title) : answer(title, settings.limit());
    }

    private List<String> answer(String title, Duration limit) throws IOException {
        var answer = new FutureTask<>(() -> answer(title));
        Thread.ofPlatform().daemon().name("measuring-jvm-answer").start(answer);
        try {
            return answer.get(limit.toMillis(), TimeUnit.MILLISECONDS);
        } catch (TimeoutException late) {
            process.destroyForcibly();
            throw new IOException(
                    title + ": " + settings.name() + " did not answer in " + limit.toSeconds() + " s"
                            + settings.seeLog(),
                    late);
        } catch (ExecutionException failed) {
            if (failed.getCause() instanceof IOException known) {
                throw known;
            }
            throw new IOException(title + ": the answer cannot be read", failed.getCause());
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            throw new IOException(title + ": interrupted while waiting for " + settings.name(), interrupted);
        }
    }

    private List<String> answer(String title) throws IOException {
        String[] head = line(title).split(" ", 2);
        if (head[0].equals(FAILED)) {
            throw new IOException(title + ": " + head[1]);
        }
        String[] numbers = head.length == 2 ? head[1].split(" ") : head;
        if (!head[0].equals(DONE) || numbers.length != 2) {
            throw new IOException(title + ": " + settings.name() + " answered \"" + String.join(" ", head)
                    + "\", expected \"" + DONE + "\", the number of lines and the number of processors");
        }
        var lines = new ArrayList<String>();
        for (int left = Integer.parseInt(numbers[0]); left > 0; left--) {
            lines.add(line(title));
        }
        checkProcessors(numbers[1]);
        return lines;
    }

    private String line(String title) throws IOException {
        String line = answers.readLine();
        if (line == null) {
            throw new IOException(title + ": " + settings.name() + " has ended: " + exitStatus() + settings.seeLog());
        }
        return line;
    }

    private void checkProcessors(String count) throws IOException {
        Integer expected = settings.processors();
        if (expected != null && !count.equals(expected.toString())) {
            throw new IOException("the JVM that measures reports " + count + " processors, expected " + expected
                    + " as its options specify" + settings.seeLog());
        }
    }

    private String exitStatus() {
        try {
            return "exit status " + process.waitFor();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return "interrupted while waiting for it";
        }
    }

    /** Kills the process in any state, without waiting for its end. */
    public void end() {
        process.destroy();
    }

    /** Ends the process, even one that hangs, and waits for its end. */
    @Override
    public void close() {
        process.destroy();
        boolean ended = false;
        boolean interrupted = false;
        try {
            ended = process.waitFor(SECONDS_TO_END, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            interrupted = true;
        }
        if (!ended) {
            process.destroyForcibly();
        }
        while (process.isAlive()) { // not for long: it is killed
            try {
                process.waitFor();
            } catch (InterruptedException e) {
                interrupted = true;
            }
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
        requests.close();
    }

    /** Answers the requests in the child JVM. */
    @FunctionalInterface
    public interface Handler {
        /**
         * Answers one request.
         *
         * @return lines of text; none may contain a line break
         * @throws Exception is thrown in the parent, as an {@link IOException} with its text
         */
        List<String> answer(String request) throws Exception;
    }

    /**
     * The main method of the child JVM: reads requests from standard input and answers them on standard output, until
     * the end of the input. What the handler itself prints goes to standard error.
     *
     * @param handler creates the handler, with standard output already redirected
     * @throws Exception if the handler cannot be created
     */
    public static void serve(Callable<? extends Handler> handler) throws Exception {
        var out = new PrintWriter(System.out, false, StandardCharsets.UTF_8);
        System.setOut(System.err); // other output must not mix with the answers
        Handler created = handler.call();
        var in = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        for (String request = in.readLine(); request != null; request = in.readLine()) {
            answer(created, request, out);
        }
    }

    private static void answer(Handler handler, String request, PrintWriter out) {
        try {
            List<String> lines = handler.answer(request);
            out.println(DONE + " " + lines.size() + " " + Runtime.getRuntime().availableProcessors());
            lines.forEach(out::println);
        } catch (Exception failed) {
            out.println(FAILED + " " + failed.toString().replaceAll("\\R", " "));
        }
        out.flush();
    }
}
