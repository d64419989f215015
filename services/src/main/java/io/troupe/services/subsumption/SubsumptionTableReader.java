package io.troupe.services.subsumption;

import static java.util.Objects.requireNonNull;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;

/**
 * Reads tables from text files. A line holds one statement; the order of the lines is free, but the first {@code state}
 * is the state in which a run starts. A {@code #} followed by a blank begins a comment.
 *
 * {@snippet lang = "text":
 * robots 5
 * ignore black : walls                                   # leads to no state; the text after ':' is the reason
 * colour lilac #C8A2C8                                   # declares a colour name, which must be used
 * service patrol = goToGoal(1.5, -2; 3, 0) colours       # or 'no colours': whether its robots look for colours
 * hold 2 s
 * state blue : wallFollower, spaceWanderer, spaceWanderer, spaceWanderer, avoid > patrol
 * state lilac priority 2 : * = spaceWanderer, 3..5 = avoid > patrol
 * allow final                                            # allows states in which no robot looks for colours
 * }
 *
 * <p>NamedColours are names ({@link NamedColours#names()}), or {@code #RRGGBB}. Services are those that the file
 * declares, and the kinds of the catalogue without arguments.
 *
 * <p><b>Errors.</b> {@link SubsumptionTableException} for every error in a file, and if the file cannot be opened.
 */
public final class SubsumptionTableReader {
    private SubsumptionTableReader() {}

    /** Reads a file in UTF-8, with the standard catalogue. */
    public static SubsumptionTable read(Path file) {
        return read(file, ServiceCatalogue.standard());
    }

    /** Reads a file in UTF-8 that may use services of a catalogue. */
    public static SubsumptionTable read(Path file, ServiceCatalogue catalogue) {
        requireNonNull(catalogue, "catalogue");
        try {
            // invalid UTF-8 becomes replacement characters, which the parser reports with their position
            var text = new String(Files.readAllBytes(file), StandardCharsets.UTF_8);
            return new TableParser(file.toString(), catalogue).parse(text);
        } catch (NoSuchFileException missing) {
            throw new SubsumptionTableException(file + ": no such file, expected the text of a table", missing);
        } catch (IOException unreadable) {
            if (Files.isDirectory(file)) {
                throw new SubsumptionTableException(
                        file + " is a directory, expected a file with the text of a table", unreadable);
            }
            throw new SubsumptionTableException(
                    file + " cannot be read: " + unreadable + ", expected the text of a table", unreadable);
        }
    }

    /**
     * Parses a text.
     *
     * @param name of the text, for error messages
     */
    public static SubsumptionTable parse(String text, String name, ServiceCatalogue catalogue) {
        return new TableParser(name, catalogue).parse(text);
    }

    /** Parses the declaration of a service, such as {@code patrol = goToGoal(1.5, -2; 3, 0) colours}. */
    public static Service service(String declaration, ServiceCatalogue catalogue) {
        var line = new TableLine("service", 1, declaration);
        Service service = new ServiceReader(catalogue).declare(line);
        line.end();
        return service;
    }
}
