package io.troupe.checks.builds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/**
 * A file that a test reads outside its class path is declared as an input of Gradle's test task. Otherwise a change of
 * that file would not run the test again: with the build cache on, it would be reported as passed.
 */
class DeclaredInputsTest {
    private static final Pattern PATH = Pattern.compile("\\bPath\\.of\\(\\s*(\"[^\"]*\"(?:\\s*,\\s*\"[^\"]*\")*)");
    private static final Pattern QUOTED = Pattern.compile("\"([^\"]*)\"");

    @TempDir
    Path folder;

    @Test
    void filesThatTestsRead_areInputsOfTheirTasks() throws IOException {
        List<String> undeclared = new ArrayList<>();
        int read = 0;
        for (Path module : Repository.modules()) {
            if (!module.endsWith("checks")) { // its test task is never up to date
                read += readFiles(module).size();
                undeclared.addAll(undeclared(module));
            }
        }
        assertThat(read).as("files that tests read").isGreaterThan(20);
        assertThat(undeclared)
                .as("files that tests read and Gradle does not know of")
                .isEmpty();
    }

    @Test
    void fileOutsideTheDeclaredFolders_isNamed() throws IOException {
        var module = Files.createDirectories(folder.resolve("m"));
        Files.createDirectories(module.resolve("src/test/java"));
        Files.createDirectories(module.resolve("worlds/deep"));
        Files.createDirectories(module.resolve("tables"));
        Files.writeString(
                module.resolve("src/test/java/ATest.java"),
                "Path.of(\"tables\", name); Path.of(\n\"worlds\", \"deep\"); Path.of(\"none\"); Path.of(\".\")");
        Files.writeString(module.resolve("build.gradle.kts"), "tasks.test { inputs.files(\"worlds\") }");
        assertThat(undeclared(module)).containsExactly("m: ATest.java reads tables");
        Files.writeString(module.resolve("build.gradle.kts"), "tasks.test {\n inputs.files(\"tables\")\n}");
        assertThat(undeclared(module)).containsExactly("m: ATest.java reads worlds/deep");
    }

    /** Files that tests read and that are no input of the script of their module, each with the test. */
    private static List<String> undeclared(Path module) throws IOException {
        List<Path> inputs = inputs(module);
        List<String> undeclared = new ArrayList<>();
        for (ReadFile read : readFiles(module)) {
            if (inputs.stream().noneMatch(read.path::startsWith)) {
                undeclared.add(module.getFileName() + ": " + read.test + " reads "
                        + module.relativize(read.path).toString().replace('\\', '/'));
            }
        }
        return undeclared;
    }

    /** A file or folder that a test reads. */
    private record ReadFile(Path test, Path path) {}

    /** The paths in the test sources that exist; tests run in the folder of their module. */
    private static List<ReadFile> readFiles(Path module) throws IOException {
        var sources = new ArrayList<>(Repository.files(module.resolve("src/test/java"), ".java"));
        sources.addAll(Repository.files(module.resolve("src/test/kotlin"), ".kt"));
        List<ReadFile> files = new ArrayList<>();
        for (Path source : sources) {
            var paths = PATH.matcher(Files.readString(source));
            while (paths.find()) {
                var path =
                        module.resolve(String.join("/", quoted(paths.group(1)))).normalize();
                if (Files.exists(path) && path.startsWith(module.getParent()) && !path.equals(module)) {
                    files.add(new ReadFile(source.getFileName(), path));
                }
            }
        }
        return files;
    }

    private static List<Path> inputs(Path module) throws IOException {
        var lines = Files.readString(module.resolve("build.gradle.kts")).lines();
        return lines.filter(line -> line.contains("inputs."))
                .flatMap(line -> quoted(line).stream())
                .map(name -> module.resolve(name).normalize())
                .toList();
    }

    private static List<String> quoted(String text) {
        return QUOTED.matcher(text).results().map(match -> match.group(1)).toList();
    }
}
