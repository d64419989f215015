package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.io.BufferedInputStream;
import java.io.IOException;
import java.io.StringReader;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.function.Consumer;
import javax.xml.stream.XMLStreamException;

/**
 * Reads and writes place/transition nets in PNML, the exchange format of Petri-net tools.
 *
 * <p>A document may have one P/T net with nested pages, reference nodes, weights and an initial marking. Places and
 * transitions are named by their {@code <name>} or, without one, by their id; if two names are equal, all are named by
 * their ids. The weights of arcs between the same two nodes are added up. Graphics and tool-specific elements are
 * skipped. Priorities, which the standard lacks, are written as a {@code <toolspecific>} element that only this class
 * reads; other tools ignore it.
 *
 * <p>An inhibitor arc is read in each of the notations in use: the attribute or child {@code type}, or the child
 * {@code arctype}, has the value {@code inhibitor}. It is written in all three, because tools read different ones, in a
 * net of the type {@code inhibitorptnet}. Of several between the same two nodes the smallest weight counts.
 *
 * <p>Files of other tools (pm4py, WoPeD, PIPE, ProM, LoLA, Yasper and others) that keep to the standard only in part
 * are read with a warning, as long as they contain a P/T net. Accepted are a missing namespace, another type of net,
 * places outside of pages, and arcs without ids or with repeated ones. Final markings are dropped with a warning.
 *
 * <p><b>Errors.</b> Any other document throws {@link PnmlException} with the line and the reason. So do a document type
 * declaration, since nothing outside the document is ever read, and every element and attribute that could change the
 * meaning of the net, such as a reset arc.
 *
 * <p><b>Source.</b> ISO/IEC 15909-2, grammar of 2009.
 */
public final class Pnml {
    static final String NAMESPACE = "http://www.pnml.org/version-2009/grammar/pnml";
    static final String NET_TYPE = "http://www.pnml.org/version-2009/grammar/ptnet";
    /** The published extension of the standard for nets with inhibitor arcs; tools without them reject it. */
    static final String INHIBITOR_NET_TYPE = "http://www.pnml.org/version-2009/extensions/inhibitorptnet";

    static final String TOOL = "io.troupe.petri";

    private Pnml() {}

    /** Reads a file; warnings are logged. */
    public static PetriNet read(Path file) {
        return read(file, Pnml::log);
    }

    /**
     * Reads a file.
     *
     * @param warnings called with {@code file:line: reason}, once for each kind of deviation from the standard
     */
    public static PetriNet read(Path file, Consumer<String> warnings) {
        requireNonNull(warnings, "warnings");
        var source = file.toString();
        try (var in = new BufferedInputStream(Files.newInputStream(file))) {
            return new PnmlReader(source, PnmlReader.open(in), warnings).read();
        } catch (XMLStreamException e) {
            throw PnmlReader.malformed(source, e);
        } catch (IOException e) {
            throw new PnmlException(source, 0, "cannot be read: " + e, e);
        }
    }

    /** Reads a document from a string; {@code source} takes the place of the file in messages. Warnings are logged. */
    public static PetriNet parse(String source, String text) {
        return parse(source, text, Pnml::log);
    }

    /**
     * Reads a document from a string.
     *
     * @param source takes the place of the file in messages
     * @param warnings called with {@code source:line: reason}, once for each kind of deviation from the standard
     */
    public static PetriNet parse(String source, String text, Consumer<String> warnings) {
        requireNonNull(source, "source");
        requireNonNull(warnings, "warnings");
        try {
            return new PnmlReader(source, PnmlReader.open(new StringReader(text)), warnings).read();
        } catch (XMLStreamException e) {
            throw PnmlReader.malformed(source, e);
        }
    }

    private static void log(String warning) {
        System.getLogger(Pnml.class.getName()).log(System.Logger.Level.WARNING, warning);
    }

    /** Writes the net as a document that {@link #parse} reads as an equal net. */
    public static String toText(PetriNet net) {
        return new PnmlWriter(net).write();
    }

    /**
     * Writes the net to a file in UTF-8; an existing file is replaced.
     *
     * @throws UncheckedIOException if the file cannot be written
     */
    public static void write(PetriNet net, Path file) {
        var text = toText(net);
        try {
            Files.writeString(file, text);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + file, e);
        }
    }
}
