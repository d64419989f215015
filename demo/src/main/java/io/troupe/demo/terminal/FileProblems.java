package io.troupe.demo.terminal;

import io.troupe.common.text.Suggestions;
import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.DirectoryNotEmptyException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.NotDirectoryException;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.stream.Collectors;
import java.util.stream.Stream;
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
     * An input file that the user names. A name that is no file here is looked up in the installation.
     *
     * @return the file
     * @throws ParameterException if it is missing, a directory, or not readable
     */
    public static Path input(CommandSpec spec, Path named, String expected) {
        Path file = Installation.find(named);
        String problem = Files.isDirectory(file)
                ? "a directory, expected " + expected
                : !Files.exists(file)
                        ? "no such file, expected " + expected + looked(file)
                        : Files.isReadable(file) ? "" : "permission denied";
        if (!problem.isEmpty()) {
            throw new ParameterException(spec.commandLine(), file + ": " + problem);
        }
        return file;
    }

    /** Where a name was looked for, if that may be at several places, and a name like it. */
    private static String looked(Path named) {
        String places = Stream.concat(Stream.of(Path.of("")), Installation.places(named).stream())
                .map(each -> each.toAbsolutePath().normalize().toString())
                .distinct()
                .collect(Collectors.joining(", "));
        Path name = named.getFileName();
        return (Installation.places(named).isEmpty() ? "" : "; looked in " + places)
                + (name == null ? "" : Suggestions.clause(name.toString(), Installation.known(named)));
    }

    /**
     * Rejects an output file that cannot be created or written, before the command starts.
     *
     * @throws ParameterException if it is a directory, or its parent directory is missing, or it cannot be written
     */
    public static void checkOutput(CommandSpec spec, String option, Path file) {
        Path directory = file.toAbsolutePath().getParent();
        String problem = Files.isDirectory(file)
                ? "that is a directory, expected a file"
                : directory == null || !Files.isDirectory(directory)
                        ? "there is no directory " + directory
                        : unwritable(file);
        if (!problem.isEmpty()) {
            throw new ParameterException(spec.commandLine(), option + " is " + file + ", but " + problem);
        }
    }

    /** Why a file cannot be written; empty if it can. Tried out, because of read-only and virtual file systems. */
    private static String unwritable(Path file) {
        boolean exists = Files.exists(file);
        if (exists && !Files.isRegularFile(file)) {
            return Files.isWritable(file) ? "" : "permission denied"; // a device, or a pipe without a reader
        }
        try {
            Files.newByteChannel(file, StandardOpenOption.CREATE, StandardOpenOption.WRITE)
                    .close();
            if (!exists) {
                Files.delete(file);
            }
            return "";
        } catch (IOException e) {
            return "it cannot be written" + because(e);
        }
    }

    /** The reason why something cannot be created, after a colon; empty if the file system gives none. */
    static String because(IOException e) {
        return e instanceof NoSuchFileException ? "" : ": " + reason(e);
    }
}
