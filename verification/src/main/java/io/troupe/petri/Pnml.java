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
 * Place/transition nets in PNML, the exchange format of Petri-net tools.
 *
 * <p>Read are documents with one P/T net: pages in pages, reference nodes, weights and initial markings. Places and
 * transitions are called by their {@code <name>}, where they have one, or all by their ids if two of those names are
 * equal. Arcs between the same two nodes add up. Pictures and the remarks of tools are skipped. Priorities, which the
 * standard does not have, are written as a {@code <toolspecific>} remark that only this class understands; other tools
 * ignore it.
 *
 * <p>Files of other tools (pm4py, WoPeD, PIPE, ProM, LoLA, Yasper and their like) that keep to the standard in part are
 * read too, with a warning, as long as their content is that of a P/T net: without its namespace, of another type of
 * net, places outside of pages, arcs without ids or with repeated ones. Final markings are left out, with a warning.
 *
 * <p><b>Errors.</b> What is not such a document throws {@link PnmlException} with the line and the reason; so do a
 * document type declaration (nothing outside the document is ever read) and every element and attribute that could
 * change what the net means, an inhibitor arc for one, in whichever way it is written.
 *
 * <p><b>Source.</b> ISO/IEC 15909-2, grammar of 2009.
 */
public final class Pnml {
    static final String NAMESPACE = "http://www.pnml.org/version-2009/grammar/pnml";
    static final String NET_TYPE = "http://www.pnml.org/version-2009/grammar/ptnet";
    static final String TOOL = "io.troupe.petri";

    private Pnml() {}

    /** Reads a file; warnings are logged. */
    public static PetriNet read(Path file) {
        return read(file, Pnml::log);
    }

    /**
     * Reads a file.
     *
     * @param warnings called with {@code file:line: reason} for each kind of deviation from the standard
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

    /** Reads a document given as text; {@code source} stands for the file in messages. Warnings are logged. */
    public static PetriNet parse(String source, String text) {
        return parse(source, text, Pnml::log);
    }

    /**
     * Reads a document given as text.
     *
     * @param source stands for the file in messages
     * @param warnings called with {@code source:line: reason} for each kind of deviation from the standard
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

    /** The net as a document that {@link #parse} turns into an equal one. */
    public static String toText(PetriNet net) {
        return new PnmlWriter(net).write();
    }

    /**
     * Writes the net to a file in UTF-8, in place of what was there.
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
