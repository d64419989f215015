package io.troupe.services.subsumption;

import static java.util.Objects.requireNonNull;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;

/**
 * Reads tables from text files, one statement in a line, in any order; {@code #} and a blank begin a comment.
 *
 * {@snippet lang = "text":
 * robots 5
 * ignore black : walls                                   # it leads to no state; the reason is for people
 * colour lilac #C8A2C8                                   # a name of one's own; must be used
 * service patrol = goToGoal(1.5, -2; 3, 0) colours       # or 'no colours': whether its robots look for colours
 * hold 2 s
 * state blue : wallFollower, spaceWanderer, spaceWanderer, spaceWanderer, avoid > patrol
 * state lilac priority 2 : * = spaceWanderer, 3..5 = avoid > patrol
 * allow final                                            # states in which nobody looks for colours
 * }
 *
 * <p>The table begins with the first state. Colours are names ({@link Colours#names()}), or {@code #RRGGBB}. Services
 * are those that the file declares, and the kinds of the catalogue with nothing between their brackets.
 *
 * <p><b>Errors.</b> {@link SubsumptionTableException} for everything that is wrong with a file, one that cannot be
 * opened included.
 */
public final class SubsumptionTableReader {
    private SubsumptionTableReader() {}

    /** Reads a file, UTF-8. */
    public static SubsumptionTable read(Path file) {
        return read(file, ServiceCatalogue.standard());
    }

    /** Reads a file that may name services of this catalogue. */
    public static SubsumptionTable read(Path file, ServiceCatalogue catalogue) {
        requireNonNull(catalogue, "catalogue");
        try {
            // what is not UTF-8 becomes a replacement character, about which the parser can say where it is
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
     * Reads a text.
     *
     * @param name of the text, for messages
     */
    public static SubsumptionTable parse(String text, String name, ServiceCatalogue catalogue) {
        return new TableParser(name, catalogue).parse(text);
    }

    /** Makes a service of its declaration, such as {@code patrol = goToGoal(1.5, -2; 3, 0) colours}. */
    public static Service service(String declaration, ServiceCatalogue catalogue) {
        var line = new TableLine("service", 1, declaration);
        Service service = new ServiceReader(catalogue).declare(line);
        line.end();
        return service;
    }
}
