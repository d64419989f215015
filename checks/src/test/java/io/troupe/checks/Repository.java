package io.troupe.checks;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

/** The checkout that contains the running test. */
public final class Repository {
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

    /** The folders of all modules, by name: those with a POM. */
    public static List<Path> modules() {
        try (var folders = Files.list(root())) {
            return folders.filter(folder -> Files.exists(folder.resolve("pom.xml")))
                    .sorted()
                    .toList();
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }

    /** The Java sources of all modules, main and test. */
    public static List<Path> javaSources() {
        return modules().stream()
                .map(module -> module.resolve("src"))
                .filter(Files::isDirectory)
                .flatMap(Repository::javaFilesIn)
                .toList();
    }

    /** The Markdown pages of the root, of docs and of the modules, build output left out. */
    public static List<Path> markdownPages() {
        try (var files = Files.walk(root())) {
            return files.filter(file -> file.toString().endsWith(".md"))
                    .filter(file ->
                            !root().relativize(file).toString().matches("(?:.*/)?(?:target|build|out|\\.[^/]+)/.*"))
                    .sorted()
                    .toList();
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }

    private static Stream<Path> javaFilesIn(Path folder) {
        try (var files = Files.walk(folder)) {
            return files.filter(file -> file.toString().endsWith(".java")).sorted().toList().stream();
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }
}
