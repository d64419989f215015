package io.troupe.checks;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.Pattern;

/** The checkout that contains the running test. */
public final class Repository {
    private static final Pattern MODULE = Pattern.compile("<module>([^<]+)</module>");

    private Repository() {}

    /** The root folder: the one with the settings of the Gradle build, searched from the working directory upwards. */
    public static Path root() {
        var start = Path.of("").toAbsolutePath();
        for (Path folder = start; folder != null; folder = folder.getParent()) {
            if (Files.exists(folder.resolve("settings.gradle.kts"))) {
                return folder;
            }
        }
        throw new IllegalStateException("no settings.gradle.kts in " + start + " or a folder above it");
    }

    /** The text of a file in the root folder or below. */
    public static String text(String path) throws IOException {
        return Files.readString(root().resolve(path));
    }

    /** The folders of all modules, sorted: those that the POM of the root lists. */
    public static List<Path> modules() {
        try {
            var modules = MODULE.matcher(text("pom.xml")).results();
            return modules.map(module -> root().resolve(module.group(1)))
                    .sorted()
                    .toList();
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }

    /** The Java sources of all modules, main and test. */
    public static List<Path> javaSources() {
        return modules().stream()
                .flatMap(module -> files(module.resolve("src"), ".java").stream())
                .toList();
    }

    /** The Kotlin sources of all modules, main and test. */
    public static List<Path> kotlinSources() {
        return modules().stream()
                .flatMap(module -> files(module.resolve("src"), ".kt").stream())
                .toList();
    }

    /** The Markdown pages of the root, of docs and of the modules, build output left out. */
    public static List<Path> markdownPages() {
        return files(root(), ".md").stream()
                .filter(file -> !root().relativize(file).toString().matches("(?:.*/)?(?:target|build|out|\\.[^/]+)/.*"))
                .toList();
    }

    /** Everything that is kept: all files but build output and what tools have put there. */
    public static List<Path> allFiles() {
        var foreign = "(?:.*/)?(?:target|build|out|__pycache__|\\.(?:git|gradle|idea|kotlin|vscode|settings))/.*";
        return files(root(), "").stream()
                .filter(Files::isRegularFile)
                .filter(file ->
                        !root().relativize(file).toString().replace('\\', '/').matches(foreign))
                .toList();
    }

    /** The files of a folder and its folders whose paths end so, sorted; empty if there is no such folder. */
    public static List<Path> files(Path folder, String end) {
        if (!Files.isDirectory(folder)) {
            return List.of();
        }
        try (var files = Files.walk(folder)) {
            return files.filter(file -> file.toString().endsWith(end)).sorted().toList();
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }
}
