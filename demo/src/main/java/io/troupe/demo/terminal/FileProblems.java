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

/** Error messages for files, with the same wording in all commands. */
public final class FileProblems {
    private FileProblems() {}

    /** The message without class names. It starts with the file if the exception names it. */
    public static String message(IOException problem) {
        return problem instanceof FileSystemException file ? file.getFile() + ": " + reason(file) : reason(problem);
    }

    /** The message with the name of the file; some system errors, such as a full disk, do not contain it. */
    public static String message(Path file, IOException problem) {
        String words = message(problem);
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
     * Rejects an input file that cannot be read, before the command starts.
     *
     * @throws ParameterException if it is missing, a directory, or not readable
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
     * Rejects an output file that cannot be created, before the command starts.
     *
     * @throws ParameterException if it is a directory, or its parent directory is missing
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
