package io.troupe.petri;

import io.troupe.petri.PnmlDocument.Kind;
import javax.xml.stream.XMLInputFactory;
import javax.xml.stream.XMLStreamConstants;
import javax.xml.stream.XMLStreamException;
import javax.xml.stream.XMLStreamReader;
import org.jspecify.annotations.Nullable;

/* Reads the elements of one document. */
final class PnmlReader {
    /** Below the limit on nested elements that newer JDKs set. */
    private static final int MAX_PAGE_DEPTH = 50;

    private final String source;
    private final XMLStreamReader xml;
    private final PnmlDocument document;

    /** The line of the tag that was read last. */
    private int line;

    private @Nullable String netName;

    PnmlReader(String source, XMLStreamReader xml) {
        this.source = source;
        this.xml = xml;
        this.document = new PnmlDocument(source);
    }

    /** The JDK's own parser, which opens nothing but the document. */
    static XMLInputFactory newFactory() {
        var factory = XMLInputFactory.newDefaultFactory();
        factory.setProperty(XMLInputFactory.SUPPORT_DTD, false);
        factory.setProperty(XMLInputFactory.IS_SUPPORTING_EXTERNAL_ENTITIES, false);
        factory.setProperty(XMLInputFactory.IS_COALESCING, true);
        return factory;
    }

    static PnmlException malformed(String source, XMLStreamException e) {
        // the parser's own message repeats the position in its first line
        var reason = String.valueOf(e.getMessage())
                .lines()
                .reduce((first, last) -> last)
                .orElse("");
        var at = e.getLocation() == null ? 0 : e.getLocation().getLineNumber();
        return new PnmlException(source, at, reason.replaceFirst("^Message: ", ""), e);
    }

    PetriNet read() {
        try {
            while (xml.next() != XMLStreamConstants.START_ELEMENT) {
                if (xml.getEventType() == XMLStreamConstants.DTD) {
                    line = xml.getLocation().getLineNumber();
                    throw bad("a document type declaration is not accepted");
                }
            }
            line = xml.getLocation().getLineNumber();
            if (!xml.getLocalName().equals("pnml") || !Pnml.NAMESPACE.equals(xml.getNamespaceURI())) {
                throw bad("the root element is <" + xml.getLocalName() + "> in namespace \""
                        + orEmpty(xml.getNamespaceURI()) + "\", expected <pnml> in namespace \"" + Pnml.NAMESPACE
                        + "\"");
            }
            var top = line;
            while (nextChild()) {
                expect("net", "in <pnml>");
                if (netName != null) {
                    throw bad("a second net, expected one");
                }
                readNet();
            }
            if (netName == null) {
                throw bad("there is no <net>", top);
            }
        } catch (XMLStreamException e) {
            throw malformed(source, e);
        }
        return document.build(netName);
    }

    private void readNet() throws XMLStreamException {
        var id = attribute("id");
        var type = attribute("type");
        if (!type.equals(Pnml.NET_TYPE)) {
            throw bad("net " + id + " is of type \"" + type + "\", expected \"" + Pnml.NET_TYPE + "\"");
        }
        netName = id;
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "name" -> netName = orElse(text(), id);
                case "page" -> readPage(1);
                case "graphics", "toolspecific" -> skip();
                default -> throw unexpected("net " + id);
            }
        }
    }

    private void readPage(int depth) throws XMLStreamException {
        if (depth > MAX_PAGE_DEPTH) {
            throw bad("pages are nested deeper than " + MAX_PAGE_DEPTH);
        }
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "place" -> readNode(Kind.PLACE);
                case "transition" -> readNode(Kind.TRANSITION);
                case "referencePlace" -> readReference(Kind.PLACE);
                case "referenceTransition" -> readReference(Kind.TRANSITION);
                case "arc" -> readArc();
                case "page" -> readPage(depth + 1);
                case "name", "graphics", "toolspecific" -> skip();
                default -> throw unexpected("a page");
            }
        }
    }

    private void readNode(Kind kind) throws XMLStreamException {
        var start = line;
        var id = newId();
        var label = id;
        var value = 0;
        while (nextChild()) {
            var element = xml.getLocalName();
            if (element.equals("name")) {
                label = orElse(text(), id);
            } else if (element.equals("initialMarking") && kind == Kind.PLACE) {
                value = number(text(), 0, "the initial marking of place " + id);
            } else if (element.equals("toolspecific") && kind == Kind.TRANSITION && isOurs()) {
                value = readPriority(id);
            } else if (element.equals("graphics") || element.equals("toolspecific")) {
                skip();
            } else {
                throw unexpected((kind == Kind.PLACE ? "place " : "transition ") + id);
            }
        }
        document.add(new PnmlDocument.Node(kind, id, label, value, start));
    }

    private boolean isOurs() {
        return Pnml.TOOL.equals(xml.getAttributeValue(null, "tool"));
    }

    private int readPriority(String id) throws XMLStreamException {
        var priority = 0;
        while (nextChild()) {
            expect("priority", "in a remark of " + Pnml.TOOL);
            priority = number(xml.getElementText(), Integer.MIN_VALUE, "the priority of transition " + id);
        }
        return priority;
    }

    private void readReference(Kind kind) throws XMLStreamException {
        document.add(new PnmlDocument.Reference(kind, newId(), attribute("ref"), line));
        skip();
    }

    private void readArc() throws XMLStreamException {
        var start = line;
        var id = newId();
        var from = attribute("source");
        var to = attribute("target");
        var weight = 1;
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "inscription" -> weight = number(text(), 1, "the weight of arc " + id);
                case "name", "graphics", "toolspecific" -> skip();
                default -> throw unexpected("arc " + id);
            }
        }
        document.add(new PnmlDocument.Link(id, from, to, weight, start));
    }

    /** Goes to the next start tag within the current element, or to its end tag. */
    private boolean nextChild() throws XMLStreamException {
        var event = xml.nextTag();
        line = xml.getLocation().getLineNumber();
        return event == XMLStreamConstants.START_ELEMENT;
    }

    private void skip() throws XMLStreamException {
        for (var depth = 1; depth > 0; ) {
            var event = xml.next();
            depth += event == XMLStreamConstants.START_ELEMENT ? 1 : event == XMLStreamConstants.END_ELEMENT ? -1 : 0;
        }
    }

    /** The {@code <text>} of a label, in one line. */
    private @Nullable String text() throws XMLStreamException {
        var label = xml.getLocalName();
        String text = null;
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "text" -> text = xml.getElementText().strip().replaceAll("\\s*[\\r\\n\\t]\\s*", " ");
                case "graphics", "toolspecific" -> skip();
                default -> throw unexpected("<" + label + ">");
            }
        }
        return text;
    }

    private int number(@Nullable String text, int least, String what) {
        try {
            var number = Integer.parseInt(orEmpty(text).strip());
            if (number >= least) {
                return number;
            }
        } catch (NumberFormatException e) {
            // told below, as a number out of range is
        }
        throw bad(what + " is \"" + orEmpty(text) + "\", expected a whole number"
                + (least == Integer.MIN_VALUE ? "" : ", " + least + " or more"));
    }

    private String newId() {
        var id = attribute("id");
        if (document.has(id)) {
            throw bad("id " + id + " is used twice");
        }
        return id;
    }

    private String attribute(String name) {
        var value = xml.getAttributeValue(null, name);
        if (value == null || value.isBlank()) {
            throw bad("<" + xml.getLocalName() + "> has no " + name);
        }
        return value.strip();
    }

    private void expect(String element, String where) {
        if (!xml.getLocalName().equals(element)) {
            throw bad("<" + xml.getLocalName() + "> " + where + ", expected <" + element + ">");
        }
    }

    private PnmlException unexpected(String where) {
        return bad("<" + xml.getLocalName() + "> in " + where + " is not part of a place/transition net");
    }

    private PnmlException bad(String reason) {
        return bad(reason, line);
    }

    private PnmlException bad(String reason, int badLine) {
        return new PnmlException(source, badLine, reason, null);
    }

    private static String orEmpty(@Nullable String text) {
        return orElse(text, "");
    }

    private static String orElse(@Nullable String text, String otherwise) {
        return text == null || text.isEmpty() ? otherwise : text;
    }
}
