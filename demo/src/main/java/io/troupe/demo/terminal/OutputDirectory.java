package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/** Creates the directory of the option {@code --out}. */
public final class OutputDirectory {
    private OutputDirectory() {}

    /**
     * Creates the directory and its parents if they are missing.
     *
     * @throws ParameterException if it cannot be created
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
                    spec.commandLine(),
                    "--out " + directory + " cannot be made a directory: " + FileProblems.message(e));
        }
    }
}
