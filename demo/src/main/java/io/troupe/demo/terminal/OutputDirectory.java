package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/** Creates the directories of the option {@code --out} and its like. */
public final class OutputDirectory {
    private OutputDirectory() {}

    /**
     * Creates the directory of {@code --out}, and its parents, if they are missing. Call it when everything else has
     * been checked, so that a command that is used wrongly leaves no empty directory behind.
     *
     * @throws ParameterException if it cannot be created, or nothing can be written in it
     */
    public static void make(CommandSpec spec, Path directory) {
        make(spec, "--out", directory);
    }

    /** The same for another option. */
    public static void make(CommandSpec spec, String option, Path directory) {
        String problem;
        try {
            Files.createDirectories(directory);
            problem = Files.isWritable(directory) ? "" : "nothing can be written there: permission denied";
        } catch (FileAlreadyExistsException file) {
            problem = file.getFile() + " is a file, expected a directory";
        } catch (IOException e) {
            problem = "that cannot be made a directory" + FileProblems.because(e);
        }
        if (!problem.isEmpty()) {
            throw new ParameterException(spec.commandLine(), option + " is " + directory + ", but " + problem);
        }
    }
}
