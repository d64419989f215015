package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.io.IOException;
import java.io.StringReader;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
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
 * <p><b>Errors.</b> What is not such a document throws {@link PnmlException} with the line and the reason; so do a
 * document type declaration (nothing outside the document is ever read) and every element of PNML that could change
 * what the net means.
 * <p><b>Source.</b> ISO/IEC 15909-2, grammar of 2009.
 */
public final class Pnml {
    static final String NAMESPACE = "http://www.pnml.org/version-2009/grammar/pnml";
    static final String NET_TYPE = "http://www.pnml.org/version-2009/grammar/ptnet";
    static final String TOOL = "io.troupe.petri";

    private Pnml() {}

    /** Reads a file. */
    public static PetriNet read(Path file) {
        try (var in = Files.newInputStream(file)) {
            return new PnmlReader(file.toString(), PnmlReader.newFactory().createXMLStreamReader(in)).read();
        } catch (XMLStreamException e) {
            throw PnmlReader.malformed(file.toString(), e);
        } catch (IOException e) {
            throw new PnmlException(file.toString(), 0, "cannot be read: " + e, e);
        }
    }

    /** Reads a document given as text; {@code source} stands for the file in messages. */
    public static PetriNet parse(String source, String text) {
        requireNonNull(source, "source");
        try {
            return new PnmlReader(source, PnmlReader.newFactory().createXMLStreamReader(new StringReader(text))).read();
        } catch (XMLStreamException e) {
            throw PnmlReader.malformed(source, e);
        }
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
