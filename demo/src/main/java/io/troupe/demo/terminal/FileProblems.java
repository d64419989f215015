package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.DirectoryNotEmptyException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.NotDirectoryException;
import java.nio.file.Path;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/** What is wrong with a file, in the same words for all commands. */
public final class FileProblems {
    private FileProblems() {}

    /** Without names of classes; begins with the file if the system says which. */
    public static String words(IOException problem) {
        return problem instanceof FileSystemException file ? file.getFile() + ": " + reason(file) : reason(problem);
    }

    /** The same, for a file that is known: some messages of the system, as that of a full disk, name none. */
    public static String words(Path file, IOException problem) {
        String words = words(problem);
        return words.contains(file.toString()) ? words : file + ": " + words;
    }

    private static String reason(IOException problem) {
        return switch (problem) {
            case NoSuchFileException missing -> "no such file";
            case AccessDeniedException denied -> "permission denied";
            case FileAlreadyExistsException there -> "exists already";
            case NotDirectoryException file -> "not a directory";
            case DirectoryNotEmptyException full -> "directory not empty";
            case FileSystemException other when other.getReason() != null -> lower(other.getReason());
            default -> problem.getMessage() == null ? "cannot be read or written" : problem.getMessage();
        };
    }

    private static String lower(String reason) {
        return reason.substring(0, 1).toLowerCase(java.util.Locale.ROOT) + reason.substring(1);
    }

    /**
     * Refuses what a command cannot read, before it begins.
     *
     * @throws ParameterException if it is missing, a directory, or may not be read
     */
    public static void checkInput(CommandSpec spec, Path file, String expected) {
        String problem = Files.isDirectory(file)
                ? "a directory, expected " + expected
                : !Files.exists(file)
                        ? "no such file, expected " + expected
                        : Files.isReadable(file) ? "" : "permission denied";
        if (!problem.isEmpty()) {
            throw new ParameterException(spec.commandLine(), file + ": " + problem);
        }
    }

    /**
     * Refuses a place for a file that is none, before there is something to write.
     *
     * @throws ParameterException if it is a directory, or its directory is missing
     */
    public static void checkOutput(CommandSpec spec, String option, Path file) {
        Path directory = file.toAbsolutePath().getParent();
        String problem = Files.isDirectory(file)
                ? "that is a directory, expected a file"
                : directory == null || !Files.isDirectory(directory) ? "there is no directory " + directory : "";
        if (!problem.isEmpty()) {
            throw new ParameterException(spec.commandLine(), option + " is " + file + ", but " + problem);
        }
    }
}
