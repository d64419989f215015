package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/** The directory that {@code --out} names. */
public final class OutputDirectory {
    private OutputDirectory() {}

    /**
     * Makes it, and what it is in, unless it is there.
     *
     * @throws ParameterException if it cannot be made
     */
    public static void make(CommandSpec spec, Path directory) {
        try {
            Files.createDirectories(directory);
        } catch (FileAlreadyExistsException file) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--out is " + directory + ", but " + file.getFile() + " is a file, expected a directory");
        } catch (IOException e) {
            throw new ParameterException(
                    spec.commandLine(), "--out " + directory + " cannot be made a directory: " + FileProblems.words(e));
        }
    }
}
