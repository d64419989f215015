package io.troupe.demo.terminal;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** The folder of the installation, with the worlds, tables and applications that come with it. */
public final class Installation {
    /** The system property that the start scripts set; builds run in that folder. */
    public static final String PROPERTY = "troupe.home";

    private Installation() {}

    public static Path folder() {
        return Path.of(System.getProperty(PROPERTY, ""));
    }

    /** A file of {@code demo/worlds}. */
    public static Path world(String name) {
        return folder().resolve(Path.of("demo", "worlds", name));
    }

    /**
     * A file that the user names: as a path, or else below the folder of the installation, or beside the worlds, tables
     * or applications there.
     *
     * @return the name itself if there is no such file
     */
    static Path find(Path named) {
        return Stream.concat(Stream.of(named), places(named).stream().map(place -> place.resolve(named)))
                .filter(Files::exists)
                .findFirst()
                .orElse(named);
    }

    /** The folders below which a world, table or application is looked for, but for the current one. */
    static List<Path> places(Path named) {
        Path shipped = shipped(named);
        return named.isAbsolute() || shipped == null ? List.of() : List.of(folder(), shipped);
    }

    /** The files that a name of this kind may mean: those that come with the installation, and those beside it. */
    static List<String> known(Path named) {
        Path shipped = named.getParent() == null ? shipped(named) : null;
        Path beside = named.toAbsolutePath().getParent();
        String kind = ending(named);
        return Stream.of(shipped, beside)
                .filter(folder -> folder != null && Files.isDirectory(folder))
                .flatMap(folder -> names(folder).stream())
                .filter(name -> ending(Path.of(name)).equals(kind))
                .distinct()
                .sorted()
                .toList();
    }

    private static List<String> names(Path folder) {
        try (Stream<Path> files = Files.list(folder)) {
            return files.map(each -> each.getFileName().toString()).toList();
        } catch (IOException unreadable) { // this is for a suggestion only
            return List.of();
        }
    }

    private static @Nullable Path shipped(Path named) {
        String kind = switch (ending(named)) {
            case "world", "cfg" -> "worlds";
            case "table" -> "tables";
            case "app" -> "applications";
            default -> "";
        };
        return kind.isEmpty() ? null : folder().resolve(Path.of("demo", kind));
    }

    private static String ending(Path file) {
        String name = String.valueOf(file.getFileName());
        return name.substring(name.lastIndexOf('.') + 1);
    }
}
