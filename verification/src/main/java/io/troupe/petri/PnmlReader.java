package io.troupe.petri;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_8;

import io.troupe.petri.PnmlDocument.Kind;
import java.io.BufferedInputStream;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.Reader;
import java.math.BigInteger;
import java.nio.charset.CharacterCodingException;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.Consumer;
import java.util.regex.Pattern;
import javax.xml.stream.XMLInputFactory;
import javax.xml.stream.XMLStreamConstants;
import javax.xml.stream.XMLStreamException;
import javax.xml.stream.XMLStreamReader;
import org.jspecify.annotations.Nullable;

/** Reads the elements of one document. It rejects every unknown element that could change the net. */
final class PnmlReader {
    /** Below the limit on nested elements that newer JDKs set. */
    private static final int MAX_PAGE_DEPTH = 50;

    /** Enough for an XML declaration. */
    private static final int HEAD_BYTES = 512;

    private static final Pattern BYTE_ORDER_MARK = Pattern.compile("^\u00ef\u00bb\u00bf");
    private static final Pattern OTHER_ENCODING =
            Pattern.compile("^<\\?xml[^>]*\\sencoding\\s*=\\s*[\"'](?!utf-?8[\"'])", Pattern.CASE_INSENSITIVE);
    private static final Pattern WHOLE_NUMBER = Pattern.compile("[+-]?[0-9]+");
    private static final Pattern POSITIVE = Pattern.compile("(?=.*[1-9])[0-9]*\\.?[0-9]+");

    private final String source;
    private final XMLStreamReader xml;
    private final Consumer<String> warnings;
    private final Set<String> warned = new HashSet<>();
    private final PnmlDocument document;
    private final Set<String> arcIds = new HashSet<>();
    /** By element: the value of time or priority that all transitions so far have; they must all have the same. */
    private final Map<String, String> uniform = new HashMap<>();

    private final Map<String, Integer> uniformCount = new TreeMap<>();
    private int transitions;

    /** The only colour of tokens that is declared, or null. */
    private @Nullable String tokenColour;

    /** The line of the last tag read. */
    private int line;

    private @Nullable String netName;

    PnmlReader(String source, XMLStreamReader xml, Consumer<String> warnings) {
        this.source = source;
        this.xml = xml;
        this.warnings = warnings;
        this.document = new PnmlDocument(source);
    }

    /** The JDK's parser, set up never to open anything outside the document. */
    private static XMLInputFactory newFactory() {
        var factory = XMLInputFactory.newDefaultFactory();
        factory.setProperty(XMLInputFactory.SUPPORT_DTD, false);
        factory.setProperty(XMLInputFactory.IS_SUPPORTING_EXTERNAL_ENTITIES, false);
        factory.setProperty(XMLInputFactory.IS_COALESCING, true);
        return factory;
    }

    static XMLStreamReader open(Reader text) throws XMLStreamException {
        return newFactory().createXMLStreamReader(text);
    }

    /** Opens the document and decodes UTF-8 itself: the parser would print invalid bytes to standard error. */
    static XMLStreamReader open(BufferedInputStream in) throws XMLStreamException, IOException {
        in.mark(HEAD_BYTES);
        var head = new String(in.readNBytes(HEAD_BYTES), ISO_8859_1);
        in.reset();
        if (BYTE_ORDER_MARK.matcher(head).find()) {
            in.skipNBytes(3);
        } else if (head.indexOf('\0') >= 0 || head.startsWith("\u00fe\u00ff") || head.startsWith("\u00ff\u00fe")) {
            return newFactory().createXMLStreamReader(in);
        } else if (OTHER_ENCODING.matcher(head).find()) {
            return newFactory().createXMLStreamReader(in);
        }
        return open(new InputStreamReader(in, UTF_8.newDecoder()));
    }

    static PnmlException malformed(String source, XMLStreamException e) {
        var at = e.getLocation() == null ? 0 : e.getLocation().getLineNumber();
        if (e.getNestedException() instanceof CharacterCodingException) {
            return new PnmlException(
                    source, at, "the file is not in UTF-8, which it names as its encoding or by naming none", e);
        }
        // the parser's message repeats the position in its first line
        var reason = String.valueOf(e.getMessage())
                .lines()
                .reduce((first, last) -> last)
                .orElse("");
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
            if (!xml.getLocalName().equals("pnml") || !PnmlDialect.isNamespace(xml.getNamespaceURI())) {
                throw bad("the root element is <" + xml.getLocalName() + "> in namespace \""
                        + orEmpty(xml.getNamespaceURI()) + "\", expected <pnml> in namespace \"" + Pnml.NAMESPACE
                        + "\"");
            }
            requireAttributes(Set.of());
            warnOfNamespace();
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
        uniformCount.forEach((element, count) -> {
            if (count != transitions) {
                throw bad("<" + element + "> is given for " + count + " of " + transitions
                        + " transitions, expected all or none in a place/transition net");
            }
        });
        return document.build(netName);
    }

    private void warnOfNamespace() {
        if (!Pnml.NAMESPACE.equals(xml.getNamespaceURI())) {
            warn("namespace", "the namespace is \"" + orEmpty(xml.getNamespaceURI()) + "\", not that of the standard");
        }
    }

    private void readNet() throws XMLStreamException {
        var id = attribute("id");
        var type = attribute("type");
        if (!PnmlDialect.isNetType(type)) {
            throw bad("net " + id + " is of type \"" + type + "\", expected \"" + Pnml.NET_TYPE + "\"");
        }
        if (!type.equals(Pnml.NET_TYPE) && !type.equals(Pnml.INHIBITOR_NET_TYPE)) {
            warn("type", "net " + id + " is of type \"" + type + "\", read as a place/transition net");
        }
        requireAttributes(Set.of("id", "type"));
        netName = id;
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "name" -> netName = orElse(text(), id);
                case "page" -> readPage(1);
                case "graphics", "toolspecific" -> skip();
                case "token" -> readTokenColour();
                case "labels" -> skip();
                case "finalmarkings" -> {
                    warn(
                            "final",
                            "final markings are left out: a marking where nothing may fire is dead, final or not");
                    skip();
                }
                case "stategroup" -> { // written by PIPE: named sets of markings, for its queries
                    warn("state group", "groups of states are left out: they change nothing");
                    skip();
                }
                default -> {
                    var child = xml.getLocalName();
                    if (!readContent()) {
                        throw unexpected("net " + id);
                    }
                    warn("page", "<" + child + "> stands in the net itself, not in a <page>");
                }
            }
        }
    }

    /** Reads a token colour as PIPE declares it. A place/transition net has only one. */
    private void readTokenColour() throws XMLStreamException {
        if (tokenColour != null) {
            throw bad("tokens have a second colour, " + attribute("id") + "; expected one, " + tokenColour);
        }
        tokenColour = attribute("id");
        skip();
    }

    private void readPage(int depth) throws XMLStreamException {
        if (depth > MAX_PAGE_DEPTH) {
            throw bad("pages are nested deeper than " + MAX_PAGE_DEPTH);
        }
        requireAttributes(Set.of("id"));
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "page" -> readPage(depth + 1);
                case "name", "graphics", "toolspecific" -> skip();
                default -> {
                    if (!readContent()) {
                        throw unexpected("a page");
                    }
                }
            }
        }
    }

    /** Reads a node or an arc; false if the element is neither. */
    private boolean readContent() throws XMLStreamException {
        switch (xml.getLocalName()) {
            case "place" -> readNode(Kind.PLACE);
            case "transition" -> readNode(Kind.TRANSITION);
            case "referencePlace" -> readReference(Kind.PLACE);
            case "referenceTransition" -> readReference(Kind.TRANSITION);
            case "arc" -> readArc();
            default -> {
                return false;
            }
        }
        return true;
    }

    private void readNode(Kind kind) throws XMLStreamException {
        var start = line;
        var id = newId();
        var what = (kind == Kind.PLACE ? "place " : "transition ") + id;
        requireAttributes(Set.of("id"));
        var label = id;
        var value = 0L;
        var seen = new HashSet<String>();
        while (nextChild()) {
            var element = xml.getLocalName();
            if (element.equals("graphics") || element.equals("orientation")) {
                skip();
            } else if (element.equals("toolspecific")) {
                if (kind == Kind.TRANSITION && isOurs()) {
                    value = readPriority(id);
                } else {
                    skip();
                }
            } else if (!seen.add(element)) {
                throw bad("a second <" + element + "> in " + what);
            } else if (element.equals("name")) {
                label = orElse(text(), id);
            } else if (element.equals("initialMarking") && kind == Kind.PLACE) {
                value = number(plain(number(element)), 0, Long.MAX_VALUE, "the initial marking of place " + id);
            } else if (kind == Kind.PLACE && (element.equals("capacity") || element.equals("tagged"))
                    || kind == Kind.TRANSITION && element.equals("infiniteServer")) {
                requireNeutral(element, text(), what);
            } else if (kind == Kind.TRANSITION && PnmlDialect.isUniform(element)) {
                requireUniform(element, orEmpty(text()), what);
            } else {
                throw unexpected(what);
            }
        }
        transitions += kind == Kind.TRANSITION ? 1 : 0;
        document.add(new PnmlDocument.Node(kind, id, label, value, start));
    }

    /** Accepts a priority or a rate above 0 only if it is the same for all transitions: then it has no effect. */
    private void requireUniform(String element, String value, String what) {
        if (element.equals("rate")) {
            if (!POSITIVE.matcher(value).matches()) {
                throw bad("<rate> of " + what + " is \"" + value + "\", expected a number above 0");
            }
            return;
        }
        uniformCount.merge(element, 1, Integer::sum);
        var first = uniform.putIfAbsent(element, value);
        if (first != null && !first.equals(value)) {
            throw bad("<" + element + "> of " + what + " is \"" + value + "\", that of another is \"" + first
                    + "\", expected the same for all transitions of a place/transition net");
        }
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
        var start = line;
        var id = newId();
        var target = attribute("ref");
        requireAttributes(Set.of("id", "ref"));
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "name", "graphics", "toolspecific" -> skip();
                default -> throw unexpected("reference " + id);
            }
        }
        document.add(new PnmlDocument.Reference(kind, id, target, start));
    }

    private void readArc() throws XMLStreamException {
        var start = line;
        var from = attribute("source");
        var to = attribute("target");
        var id = orEmpty(xml.getAttributeValue(null, "id"));
        var arc = "arc " + (id.isBlank() ? from + " -> " + to : id);
        requireAttributes(Set.of("id", "source", "target"));
        if (id.isBlank()) {
            warn("arc without id", arc + " has no id");
        } else if (!arcIds.add(id) || document.has(id)) {
            warn("arc id", "id " + id + " of an arc is used twice");
        }
        var weight = 1;
        var kinds = kindsOfAttributes();
        var name = "1";
        var seen = new HashSet<String>();
        while (nextChild()) {
            var element = xml.getLocalName();
            switch (element) {
                case "graphics", "arcpath" -> {
                    skip();
                    continue;
                }
                case "toolspecific" -> {
                    skipToolSpecific(arc);
                    continue;
                }
                case "inscription" -> weight = number(plain(number(element)), 1, "the weight of " + arc);
                case "name" -> name = orEmpty(text());
                case "type", "arctype", "tagged" -> readKind(element, arc, kinds);
                default -> throw unexpected(arc);
            }
            if (!seen.add(element)) {
                throw bad("a second <" + element + "> in " + arc);
            }
        }
        if (!seen.contains("inscription")
                && !name.equals("1")
                && WHOLE_NUMBER.matcher(name).matches()) {
            // ProM shows the weight of an arc as its name
            throw bad(
                    arc + " is called \"" + name + "\" and has no <inscription>, expected one if that is its weight",
                    start);
        }
        if (kinds.size() > 1) {
            throw bad(arc + " is an inhibitor arc and a normal one, expected one kind", start);
        }
        var inhibits = kinds.contains("inhibitor");
        document.add(new PnmlDocument.Link(id.isBlank() ? from + " -> " + to : id, from, to, weight, inhibits, start));
    }

    private void readKind(String element, String arc, Set<String> kinds) throws XMLStreamException {
        var attribute = xml.getAttributeValue(null, "value");
        var value = attribute == null ? text() : attribute;
        if (PnmlDialect.isInhibitor(element, value)) {
            kinds.add("inhibitor");
        } else {
            requireNeutral(element, value, arc);
            if (!element.equals("tagged")) {
                kinds.add("normal");
            }
        }
        if (attribute != null) {
            skip();
        }
    }

    /** The kinds that the attributes of an arc name; {@link #requireAttributes} has checked them. */
    private Set<String> kindsOfAttributes() {
        var kinds = new HashSet<String>();
        for (var name : List.of("type", "arctype")) {
            var value = xml.getAttributeValue(null, name);
            if (value != null) {
                kinds.add(value.strip());
            }
        }
        return kinds;
    }

    /** What a tool writes for itself is not part of the net; a word that would change the net is a warning. */
    private void skipToolSpecific(String what) throws XMLStreamException {
        var tool = orEmpty(xml.getAttributeValue(null, "tool"));
        for (var depth = 1; depth > 0; ) {
            var event = xml.next();
            depth += event == XMLStreamConstants.START_ELEMENT ? 1 : event == XMLStreamConstants.END_ELEMENT ? -1 : 0;
            if (event == XMLStreamConstants.START_ELEMENT && isAboutInhibitors()
                    || event == XMLStreamConstants.CHARACTERS && xml.getText().contains("inhibitor")) {
                warn(
                        "inhibitor of a tool",
                        "what the tool \"" + tool + "\" has written about an inhibitor in " + what
                                + " is left out, expected type=\"inhibitor\" at the arc");
            }
        }
    }

    private boolean isAboutInhibitors() {
        var isAbout = xml.getLocalName().contains("inhibitor");
        for (var i = 0; i < xml.getAttributeCount(); i++) {
            isAbout |= xml.getAttributeValue(i).contains("inhibitor")
                    || xml.getAttributeLocalName(i).contains("inhibitor");
        }
        return isAbout;
    }

    /** Checks that every attribute is in {@code known}, only draws the element, or has a value without effect. */
    private void requireAttributes(Set<String> known) {
        for (var i = 0; i < xml.getAttributeCount(); i++) {
            var name = xml.getAttributeLocalName(i);
            var namespace = xml.getAttributeNamespace(i);
            var isPlain = namespace == null || namespace.isEmpty();
            if (PnmlDialect.isForeign(namespace) || isPlain && (known.contains(name) || PnmlDialect.isDrawn(name))) {
                continue;
            }
            var what = "<" + xml.getLocalName() + ">"
                    + orEmpty(xml.getAttributeValue(null, "id")).replaceFirst("^", " ");
            if (isPlain
                    && xml.getLocalName().equals("arc")
                    && PnmlDialect.isInhibitor(name, xml.getAttributeValue(i))) {
                continue;
            }
            if (isPlain && PnmlDialect.mayBeNeutral(name)) {
                requireNeutral(name, xml.getAttributeValue(i), what.strip());
            } else {
                throw bad("attribute " + name + "=\"" + xml.getAttributeValue(i) + "\" of " + what.strip()
                        + " is not part of a place/transition net");
            }
        }
    }

    private void requireNeutral(String name, @Nullable String value, String what) {
        if (!PnmlDialect.isNeutral(name, orEmpty(value).strip())) {
            throw bad(name + " of " + what + " is \"" + orEmpty(value) + "\", expected " + PnmlDialect.neutral(name)
                    + " in a place/transition net");
        }
    }

    /** Moves to the next start tag within the current element, or to its end tag. */
    private boolean nextChild() throws XMLStreamException {
        var event = xml.nextTag();
        line = xml.getLocation().getLineNumber();
        if (event != XMLStreamConstants.START_ELEMENT) {
            return false;
        }
        if (!PnmlDialect.isNamespace(xml.getNamespaceURI())) {
            throw bad("<" + xml.getLocalName() + "> is of namespace \"" + xml.getNamespaceURI()
                    + "\" and no part of a place/transition net");
        }
        return true;
    }

    private void skip() throws XMLStreamException {
        for (var depth = 1; depth > 0; ) {
            var event = xml.next();
            depth += event == XMLStreamConstants.START_ELEMENT ? 1 : event == XMLStreamConstants.END_ELEMENT ? -1 : 0;
        }
    }

    /** The text of a label that is a number; the label may have no attributes with an effect. */
    private @Nullable String number(String element) throws XMLStreamException {
        requireAttributes(Set.of());
        return text();
    }

    /** The {@code <text>} of a label, in one line; some tools use {@code <value>} instead. */
    private @Nullable String text() throws XMLStreamException {
        var label = xml.getLocalName();
        String text = null;
        while (nextChild()) {
            switch (xml.getLocalName()) {
                case "text", "value" -> {
                    if (text != null) {
                        throw bad("a second <" + xml.getLocalName() + "> in <" + label + ">");
                    }
                    if (xml.getLocalName().equals("value")) {
                        warn("value", "the text of <" + label + "> stands in <value>, not in <text>");
                    }
                    text = xml.getElementText().strip().replaceAll("\\s*[\\r\\n\\t]\\s*", " ");
                }
                case "graphics", "toolspecific" -> skip();
                default -> throw unexpected("<" + label + ">");
            }
        }
        return text;
    }

    /** The text without the colour that PIPE writes before a number of tokens. */
    private @Nullable String plain(@Nullable String text) {
        var colour = tokenColour == null ? "Default" : tokenColour;
        return text != null && text.startsWith(colour + ",") ? text.substring(colour.length() + 1) : text;
    }

    private int number(@Nullable String text, int least, String what) {
        return (int) number(text, least, Integer.MAX_VALUE, what);
    }

    private long number(@Nullable String text, long least, long most, String what) {
        var digits = orEmpty(text).strip();
        if (WHOLE_NUMBER.matcher(digits).matches()) {
            var number = new BigInteger(digits);
            if (number.bitLength() < Long.SIZE && number.longValue() >= least && number.longValue() <= most) {
                return number.longValue();
            }
        }
        throw bad(what + " is \"" + orEmpty(text) + "\", expected a whole number from " + least + " to " + most);
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

    /** Warns once for each kind: a file mostly repeats its deviation. */
    private void warn(String kind, String reason) {
        if (warned.add(kind)) {
            warnings.accept(source + ":" + line + ": " + reason);
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
