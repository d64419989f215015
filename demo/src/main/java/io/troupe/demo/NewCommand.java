package io.troupe.demo;

import static java.util.Objects.requireNonNull;

import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import java.io.File;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code troupe new}: writes a small project to begin with, which runs with one command. */
@Command(
        name = "new",
        description = "Writes a small project to begin with: a world, and a Player program if it is one of that kind.",
        footer = {"  troupe new maze", "  troupe new my-robot --kind player"},
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
final class NewCommand implements Callable<Integer> {
    /** What the project is about. */
    enum Kind {
        WORLD,
        PLAYER
    }

    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "FOLDER", description = "a new or an empty folder")
    private Path folder;

    @Option(
            names = "--kind",
            paramLabel = "KIND",
            description =
                    "WORLD: a world for the services of troupe run; PLAYER: the world and a Player program in Java that drives in it")
    private Kind kind = Kind.WORLD;

    @Override
    public Integer call() throws IOException {
        if (Files.isDirectory(folder)) {
            try (Stream<Path> files = Files.list(folder)) {
                if (files.findAny().isPresent()) {
                    throw new ParameterException(
                            spec.commandLine(), "FOLDER is " + folder + ", which is not empty, expected a new folder");
                }
            }
        }
        OutputDirectory.make(spec, "FOLDER", folder);
        write("hall.world", resource("hall.world"));
        if (kind == Kind.PLAYER) {
            write("MyRobot.java", resource("MyRobot.java"));
            write("classpath", classPath());
        }
        String readme = resource(kind == Kind.PLAYER ? "player.md" : "world.md")
                .replace("{troupe}", troupe())
                .replace("{java}", quoted(Path.of(System.getProperty("java.home"), "bin", "java")))
                .replace("{guides}", guides());
        write("README.md", readme);
        String command = readme.lines()
                .filter(line -> line.startsWith("    "))
                .findFirst()
                .orElseThrow();
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.println("wrote " + folder + ". Begin with");
        terminal.println();
        terminal.println("    cd " + quoted(folder));
        terminal.println(command);
        terminal.println();
        terminal.println("README.md there has more");
        terminal.flush();
        return 0;
    }

    private void write(String name, String text) throws IOException {
        OutputFiles.write(folder.resolve(name), text);
    }

    private static String resource(String name) throws IOException {
        try (var stream = NewCommand.class.getResourceAsStream("project/" + name)) {
            return new String(requireNonNull(stream, name).readAllBytes(), StandardCharsets.UTF_8);
        }
    }

    /** The start script of the checkout or of the installation. */
    private static String troupe() {
        Path home = Installation.folder().toAbsolutePath();
        String name = File.separatorChar == '\\' ? "troupe.bat" : "troupe";
        return Stream.of(home.resolve(name), home.resolve("bin").resolve(name))
                .filter(Files::isRegularFile)
                .findFirst()
                .map(NewCommand::quoted)
                .orElse("troupe");
    }

    private static String guides() {
        Path guides = Installation.folder().toAbsolutePath().resolve(Path.of("docs", "guide"));
        return Files.isDirectory(guides) ? guides.toString() : "docs/guide";
    }

    /** A file of arguments for java, with the class path of this program. */
    private static String classPath() {
        String path = Stream.of(System.getProperty("java.class.path").split(Pattern.quote(File.pathSeparator)))
                .map(each -> Path.of(each).toAbsolutePath().toString())
                .collect(Collectors.joining(File.pathSeparator));
        return "-cp \"" + path.replace("\\", "\\\\") + "\"\n";
    }

    /** A path as a word of a command line. */
    private static String quoted(Path path) {
        String text = path.toString();
        return List.of(" ", "'", "(", "&", "$").stream().anyMatch(text::contains) ? '"' + text + '"' : text;
    }
}
