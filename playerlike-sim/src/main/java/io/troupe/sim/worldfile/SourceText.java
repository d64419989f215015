package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.SourceScanner;
import java.io.File;
import java.io.IOException;
import java.lang.System.Logger.Level;
import java.nio.charset.CharacterCodingException;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** Finds and reads files that the user or another file names. */
final class SourceText {
    private static final long MOST_BYTES = 16_000_000;

    private static final List<Path> STAGE_FOLDERS = stageFolders(System.getenv("STAGEPATH"));

    private SourceText() {}

    /**
     * The text of a file.
     *
     * @param namedAt position where the file is named; null if the user named it
     */
    static String read(Path file, @Nullable SourcePosition namedAt) {
        if (!Files.isRegularFile(file)) {
            throw problem(namedAt, Files.exists(file) ? file + " is not a file" : "there is no file " + file);
        }
        try {
            if (Files.size(file) > MOST_BYTES) {
                throw problem(namedAt, file + " is larger than " + MOST_BYTES + " bytes");
            }
            return SourceScanner.withoutMark(Files.readString(file));
        } catch (CharacterCodingException e) {
            throw problem(namedAt, file + " is not UTF-8 text");
        } catch (IOException e) {
            throw problem(namedAt, "cannot read " + file + ": " + e);
        }
    }

    /** Path of a file that another one names, relative to that other one. */
    static Path sibling(Path file, String name, SourcePosition namedAt) {
        try {
            return file.resolveSibling(name).normalize();
        } catch (InvalidPathException e) {
            throw new WorldFileException(namedAt, "\"" + name + "\" is not a file name: " + e.getReason());
        }
    }

    /**
     * Path of a file that another one names: beside it, beside the first file, or in Stage's world folders.
     *
     * @param first the file that the user named
     */
    static Path sibling(Path file, Path first, String name, SourcePosition namedAt) {
        return find(file, first, STAGE_FOLDERS, name, namedAt);
    }

    /** The first candidate that exists; if none exists, the one beside the naming file. */
    static Path find(Path file, Path first, List<Path> folders, String name, SourcePosition namedAt) {
        Path beside = sibling(file, name, namedAt);
        return Stream.concat(
                        Stream.of(beside, sibling(first, name, namedAt)),
                        folders.stream().map(folder -> folder.resolve(name).normalize()))
                .filter(Files::isRegularFile)
                .findFirst()
                .orElse(beside);
    }

    /** The folders of {@code STAGEPATH} and those in which Stage installs its worlds. */
    static List<Path> stageFolders(@Nullable String path) {
        var folders = new ArrayList<Path>();
        for (String folder : (path == null ? "" : path).split(Pattern.quote(File.pathSeparator))) {
            try {
                if (!folder.isBlank()) {
                    folders.add(Path.of(folder));
                }
            } catch (InvalidPathException e) {
                System.getLogger(SourceText.class.getName())
                        .log(Level.WARNING, "STAGEPATH names \"{0}\", which is no folder: {1}", folder, e.getReason());
            }
        }
        folders.add(Path.of("/usr/local/share/stage/worlds"));
        folders.add(Path.of("/usr/share/stage/worlds"));
        return List.copyOf(folders);
    }

    private static WorldFileException problem(@Nullable SourcePosition namedAt, String problem) {
        return namedAt == null ? new WorldFileException(problem) : new WorldFileException(namedAt, problem);
    }
}
