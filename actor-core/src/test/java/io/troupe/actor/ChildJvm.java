package io.troupe.actor;

import java.io.IOException;
import java.lang.ProcessBuilder.Redirect;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;

/** Runs programs in a separate JVM, to their end. */
final class ChildJvm {
    /** What a program has printed, and its exit status. */
    record Result(List<String> lines, int exitStatus) {}

    private ChildJvm() {}

    /** Runs a main class with this JVM's Java runtime and class path; its errors are those of the test. */
    static Result run(List<String> options, Class<?> program, String... arguments)
            throws IOException, InterruptedException {
        return run(Redirect.INHERIT, options, program, arguments);
    }

    static Result run(Redirect errors, List<String> options, Class<?> program, String... arguments)
            throws IOException, InterruptedException {
        var all = new ArrayList<>(options);
        all.addAll(List.of("-cp", System.getProperty("java.class.path"), program.getName()));
        all.addAll(List.of(arguments));
        return run(errors, Path.of(System.getProperty("java.home")), all);
    }

    /** @param home a Java runtime */
    static Result run(Redirect errors, Path home, List<String> arguments) throws IOException, InterruptedException {
        var command =
                new ArrayList<>(List.of(home.resolve("bin").resolve("java").toString()));
        command.addAll(arguments);
        var child = new ProcessBuilder(command).redirectError(errors).start();
        try (var lines = child.inputReader()) {
            var all = lines.lines().toList();
            return new Result(all, child.waitFor(1, TimeUnit.MINUTES) ? child.exitValue() : -1);
        } finally {
            child.destroyForcibly();
        }
    }
}
