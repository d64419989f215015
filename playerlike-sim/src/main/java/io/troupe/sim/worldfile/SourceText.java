package io.troupe.sim.worldfile;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.SourcePosition;
import io.troupe.common.text.SourceScanner;
import io.troupe.common.text.Suggestions;
import java.io.File;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.System.Logger.Level;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** Finds and reads files that the user or another file names. */
final class SourceText {
    private static final long MOST_BYTES = 16_000_000;

    private static final List<Path> STAGE_FOLDERS = stageFolders(System.getenv("STAGEPATH"));
    /** A file in the world folder of some version of Stage, wherever that is installed. */
    private static final Pattern FILE_OF_STAGE =
            Pattern.compile("(?i).*[/\\\\]stage[^/\\\\]*[/\\\\]worlds[/\\\\]([^/\\\\]+)");

    /** The files that come with us, in the folder {@code includes} of the resources. */
    static final List<String> OURS = List.of(
            "hokuyo.inc",
            "map.inc",
            "pioneer.inc",
            "sick.inc",
            "stage4/hokuyo.inc",
            "stage4/pioneer.inc",
            "stage4/sick.inc");

    /** The folder of {@link #OURS} in messages. */
    private static final Path BUILT_IN = Path.of("built-in");

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
        return find(file, first, STAGE_FOLDERS, name, namedAt)
                .orElseThrow(() -> problem(namedAt, "there is no file " + name + looked(file, first, name)));
    }

    /**
     * Reads a file that another one includes, from where bitmaps are looked for, too, or else one of those that come
     * with us: by its name, or by its path in an installed Stage, with a warning.
     *
     * @param first the file that the user named
     */
    static Included include(Path file, Path first, String name, SourcePosition namedAt, Diagnostics diagnostics) {
        Optional<Path> found = find(file, first, STAGE_FOLDERS, name, namedAt);
        if (found.isPresent()) {
            return new Included(found.get(), read(found.get(), namedAt));
        }
        Matcher ofStage = FILE_OF_STAGE.matcher(name);
        String ours = ofStage.matches() ? ofStage.group(1) : name;
        if (!OURS.contains(ours)) {
            throw problem(
                    namedAt,
                    "there is no file " + name + looked(file, first, name) + "; with Troupe come "
                            + String.join(", ", OURS) + Suggestions.clause(ours, OURS));
        }
        if (ofStage.matches()) {
            diagnostics.warn(
                    namedAt, "there is no file " + name + "; the " + ours + " that comes with Troupe is read instead");
        }
        return new Included(BUILT_IN.resolve(ours), ours(ours));
    }

    /** An included file, and its text. */
    record Included(Path file, String text) {}

    private static String ours(String name) {
        try (var stream = SourceText.class.getResourceAsStream("includes/" + name)) {
            return new String(requireNonNull(stream, name).readAllBytes(), StandardCharsets.UTF_8);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** The first candidate that is a file, or else the one beside the naming file if something else is there. */
    static Optional<Path> find(Path file, Path first, List<Path> folders, String name, SourcePosition namedAt) {
        Path beside = sibling(file, name, namedAt);
        // of a path in another installation of Stage its file name
        Path inFolder = beside.isAbsolute() && beside.equals(Path.of(name)) ? beside.getFileName() : Path.of(name);
        return Stream.concat(
                        Stream.of(beside, sibling(first, name, namedAt)),
                        folders.stream().map(folder -> folder.resolve(inFolder).normalize()))
                .filter(Files::isRegularFile)
                .findFirst()
                .or(() -> Optional.of(beside).filter(Files::exists));
    }

    /** Where a file was looked for. */
    private static String looked(Path file, Path first, String name) {
        return Path.of(name).isAbsolute()
                ? ""
                : Stream.concat(Stream.of(folder(file), folder(first)), STAGE_FOLDERS.stream())
                        .distinct()
                        .map(Path::toString)
                        .collect(Collectors.joining(", ", "; looked in ", ""));
    }

    private static Path folder(Path file) {
        Path parent = file.toAbsolutePath().normalize().getParent();
        return parent == null ? file : parent;
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
