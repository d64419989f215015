package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.lang.management.ManagementFactory;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.io.TempDir;

/**
 * Runs command lines and keeps what they print. A line is split at spaces; in its words and in expected texts
 * {@code DIR} is a temporary directory, and {@code DIR/name} a file there.
 */
public abstract class CommandLineBench {
    protected static final String ARENA = "--world worlds/paper-arena.world ";
    private static final Pattern FILE = Pattern.compile("DIR/?([\\w./-]*\\w)?");

    protected final StringWriter out = new StringWriter();
    protected final StringWriter err = new StringWriter();

    @TempDir
    protected Path directory;

    protected final String local(String text) {
        return FILE.matcher(text).replaceAll(file -> {
            String name = file.group(1) == null ? "" : file.group(1);
            return Matcher.quoteReplacement(directory.resolve(name).toString());
        });
    }

    protected final List<String> words(String line) {
        return Stream.of(line.split(" "))
                .filter(word -> !word.isEmpty())
                .map(this::local)
                .toList();
    }

    protected final Path file(String name, String text) throws IOException {
        Path file = directory.resolve(name);
        Files.createDirectories(file.getParent());
        return Files.writeString(file, text);
    }

    /** Writes the arena as DIR/arena.cfg, at a port that no other world in this JVM has; returns the port. */
    protected final int arenaAtOwnPort() throws IOException {
        int port = OwnPort.next();
        Path worlds = Path.of("worlds").toAbsolutePath();
        String arena = Files.readString(worlds.resolve("paper-arena.cfg"))
                .replaceAll("\"(?=[a-z0-9]+:\\d+\")", "\"" + port + ":")
                .replace("paper-arena.world", worlds.resolve("paper-arena.world") + "");
        file("arena.cfg", arena);
        return port;
    }

    protected final String written(String name) throws IOException {
        return Files.readString(directory.resolve(name));
    }

    protected final void assertWritten(String... names) {
        assertThat(names)
                .isNotEmpty()
                .allSatisfy(name -> assertThat(directory.resolve(name)).isNotEmptyFile());
    }

    protected final void assertMissing(String... names) {
        assertThat(names)
                .isNotEmpty()
                .allSatisfy(name -> assertThat(directory.resolve(name)).doesNotExist());
    }

    /** Returns the exit status of a line, to which whole arguments are added. */
    protected final int troupe(String line, Object... more) {
        var all = new ArrayList<>(words(line));
        Stream.of(more).map(Object::toString).forEach(all::add);
        return Main.execute(new PrintWriter(out), new PrintWriter(err), all.toArray(String[]::new));
    }

    /** Returns what a line has printed that ends with status 0. */
    protected final String printed(String line, Object... more) {
        out.getBuffer().setLength(0);
        assertThat(troupe(line, more)).as(() -> out + "" + err).isZero();
        return out.toString();
    }

    protected final void assertRefused(String line, String... parts) {
        assertFails(Main.USAGE, line, parts);
    }

    /**
     * The error is one line with the given parts, and may have an indented excerpt of a file below it. The line begins
     * with the first part if that has "troupe: ".
     */
    protected final void assertFails(int status, String line, String... parts) {
        err.getBuffer().setLength(0);
        assertThat(troupe(line)).isEqualTo(status);
        String[] expected = Stream.of(parts).map(this::local).toArray(String[]::new);
        assertThat(err.toString().lines().filter(each -> !each.startsWith("    ")))
                .singleElement()
                .asString()
                .startsWith(expected[0].startsWith("troupe: ") ? expected[0] : "troupe: ")
                .contains(expected);
    }

    /** A new JVM with the class path of the tests. */
    static ProcessBuilder jvm(String option, Class<?> main, List<String> arguments) {
        var java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        var command = new ArrayList<>(List.of(java, option));
        ManagementFactory.getRuntimeMXBean().getInputArguments().stream()
                .filter(each -> each.startsWith("-XX:")) // it compiles as this JVM does
                .forEach(command::add);
        command.addAll(List.of("-cp", System.getProperty("java.class.path"), main.getName()));
        command.addAll(arguments);
        return new ProcessBuilder(command);
    }
}
