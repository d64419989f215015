package io.troupe.petri;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_16;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.assertj.core.api.AbstractThrowableAssert;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Our files, and those of other tools: read with a warning if they contain a plain net, otherwise rejected. */
class PnmlTest {
    private static final String PNML = "<pnml xmlns='" + Pnml.NAMESPACE + "'>";
    private static final String STANDARD =
            PNML + "<net id='n' type='" + Pnml.NET_TYPE + "'><page id='g'>\n%s\n</page></net></pnml>";
    private static final String OPEN = "<pnml><net id='n' type='%s'>\n%s\n</net></pnml>";
    private static final String NODES = "<place id='p'/><transition id='t'/>";

    @TempDir
    Path directory;

    private final List<String> warnings = new ArrayList<>();

    private PetriNet read(String form, Object... parts) {
        return Pnml.parse("x", form.formatted(parts), warnings::add);
    }

    private AbstractThrowableAssert<?, ?> assertRefused(String form, Object... parts) {
        return assertThatThrownBy(() -> read(form, parts)).isInstanceOf(PnmlException.class);
    }

    @ParameterizedTest
    @EnumSource
    void file_writtenAndReadBack_isTheSameNet(PaperNets.Reading reading) {
        var file = directory.resolve("net.pnml");
        for (var net : List.of(
                PaperNets.uncorrected(reading), PaperNets.corrected(reading), PaperNets.lowPriorityStops(reading))) {
            Pnml.write(net, file);
            var back = Pnml.read(file);
            assertThat(back.structure()).isEqualTo(net.structure());
            assertThat(back.name()).isEqualTo(net.name());
            assertThat(back.places()).isEqualTo(net.places());
            assertThat(back.transitions()).isEqualTo(net.transitions());
        }
    }

    @Test
    void net_withStrangeNamesAndWeights_survives() {
        var go = "go & <b>'go'</b>";
        var net = PetriNet.builder("a < b & \"c\" ]]>").place("1st", 7);
        List.of("_st", "_1st", "\u00e9t\u00e9 \ud83e\udd16", "page", "a1").forEach(net::place);
        net.transition(go, List.of("page"), List.of("_st", "a1"))
                .arc("1st", go, 3)
                .priority(go, Integer.MIN_VALUE);
        var back = Pnml.parse("text", Pnml.toText(net.build()));
        assertThat(back.name()).isEqualTo("a < b & \"c\" ]]>");
        assertThat(back.structure()).isEqualTo(net.build().structure());
    }

    @Test
    void page_withEverythingAPtNetMayHold_isRead() {
        var net = read(STANDARD, """
            <name><text>first</text></name>
            <arc id="x1" source="r" target="t1"><inscription><text> 2 </text><graphics/></inscription></arc>
            <place id="p1"><name><text>full
              name</text></name><graphics><position x="1" y="2"/></graphics>
              <initialMarking><toolspecific tool="o"><x><y/></x></toolspecific><text>3</text></initialMarking></place>
            <page id="in"><transition id="t1"><toolspecific tool="o"><priority>9</priority></toolspecific></transition>
              <referencePlace id="r" ref="s"/><referencePlace id="s" ref="p1"/></page>
            <arc id="x2" source="t1" target="p1"/><arc id="x3" source="t1" target="s"/>
            """);
        assertThat(net.name()).isEqualTo("n");
        assertThat(net.structure()).isEqualTo("place full name 3\ntransition t1 0 [full name*2] -> [full name*2]");
    }

    @Test
    void names_thatAreNotUnique_giveWayToIds() {
        var net = read(
                STANDARD,
                "<place id='p1'><name><text>x</text></name></place>"
                        + "<transition id='t1'><name><text>x</text></name></transition><place id='x'/>");
        assertThat(net.places()).hasToString("[p1, x]");
        assertThat(net.transitions()).hasToString("[t1]");
    }

    /** In the bodies a ~ begins a line; the first one is line 2. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            <place id='p'/>~<place id='p'/> | 3 | id p is used twice
            <place/> | 2 | <place> has no id
            ~<place id='p'><initialMarking><text>-1</text></initialMarking></place> | 3 | \
            the initial marking of place p is "-1", expected a whole number from 0 to 9223372036854775807
            <place id='p'><initialMarking><text>99999999999999999999</text></initialMarking></place> | 2 | \
            is "99999999999999999999", expected a whole number from 0 to 9223372036854775807
            <place id='p'><initialMarking/></place> | 2 | the initial marking of place p is ""
            <place id='p'/><transition id='t'/>~<arc id='a' source='p' target='t'>~\
            <inscription><text>0</text></inscription></arc> | 4 | \
            the weight of arc a is "0", expected a whole number from 1 to 2147483647
            <place id='p'/>~<place id='q'/>~<arc id='a' source='p' target='q'/> | 4 | joins two places
            <place id='p'/>~<arc id='a' source='p' target='gone'/> | 3 | there is no place or transition with id gone
            <place id='p'/>~<arc id='a' source='p'/> | 3 | <arc> has no target
            <place id='p'/><transition id='t'/>~<arc id='a' source='p' target='t'><type value='test'/></arc> | \
            3 | type of arc a is "test", expected normal in a place/transition net
            <transition id='t'><initialMarking><text>1</text></initialMarking></transition> | 2 | \
            <initialMarking> in transition t
            <referencePlace id='r' ref='s'/>~<referencePlace id='s' ref='r'/>~<arc id='a' source='r' target='r'/> | \
            2 | reference r refers to itself
            <transition id='t'/>~<referencePlace id='r' ref='t'/>~<arc id='a' source='r' target='t'/> | 3 | \
            a reference to a place names t, which is none
            <place id='p'>~</plaice> | 3 | the matching end-tag "</place>"
            stray text | 3 | ''
            <place id='p'/><transition id='t'/>\
            <arc id='a' source='p' target='t'><inscription><text>2147483647</text></inscription></arc>~\
            <arc id='b' source='p' target='t'><inscription><text>2147483647</text></inscription></arc> | 3 | \
            the arcs from p to t weigh 4294967294 together, expected at most 2147483647
            <place id='p' initialMarking='1'/> | 2 | attribute initialMarking="1" of <place> p
            <place id='p' capacity='1'/> | 2 | capacity of <place> p is "1", expected 0 or Default,0
            <place id='p'><capacity><value>2</value></capacity></place> | 2 | capacity of place p is "2"
            <transition id='t' urgent='true'/> | 2 | urgent of <transition> t is "true", expected false
            <transition id='t' x:guard='1' xmlns:x='urn:y'/> | 2 | attribute guard="1" of <transition> t
            <transition id='t'><timed><value>true</value></timed></transition><transition id='u'/> | 3 | \
            1 of 2 transitions
            <transition id='t'><rate><value>0.0</value></rate></transition> | 2 | <rate> of transition t is "0.0"
            <place id='p'><initialMarking scale='2'><text>1</text></initialMarking></place> | 2 | \
            scale="2" of <initialMarking>
            <place id='p'><initialMarking><text>1</text><text>2</text></initialMarking></place> | 2 | a second <text>
            <place id='p'><initialMarking><text>1</text></initialMarking><initialMarking/></place> | 2 | \
            a second <initialMarking> in place p
            <x:place id='p' xmlns:x='urn:coloured'/> | 2 | <place> is of namespace "urn:coloured"
            <referencePlace id='r' ref='r'><initialMarking/></referencePlace> | 2 | <initialMarking> in reference r
            """)
    void badFile_isRefusedWithLineAndReason(String body, int line, String reason) {
        assertRefused(STANDARD, body.replace('~', '\n'))
                .hasMessageStartingWith("x:" + line + ": ")
                .hasMessageContaining(reason)
                .hasMessageNotContaining("\n");
    }

    /** As above. A timed or a reset arc, read as an ordinary arc, would change the dead markings. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            <place id='p'/><transition id='t'/>~<arc id='a' source='t' target='p' type='inhibitor'/> | \
            x:3: inhibitor arc a goes from t to p, expected from a place to a transition
            <place id='p'/><transition id='t'/>~<arc id='a' source='p' target='t' type='timed'/> | \
            x:3: type of <arc> a is "timed", expected normal in a place/transition net
            <place id='p'/><transition id='t'/>\
            <arc id='a' source='p' target='t'><arctype><text>reset</text></arctype></arc> | \
            x:2: arctype of arc a is "reset", expected normal in a place/transition net
            <transition id='t'><priority><value>1</value></priority></transition>~\
            <transition id='u'><priority><value>2</value></priority></transition> | \
            x:3: <priority> of transition u is "2", that of another is "1", \
            expected the same for all transitions of a place/transition net
            <place id='p'><tagged><value>true</value></tagged></place> | \
            x:2: tagged of place p is "true", expected false in a place/transition net
            <place id='p'/><transition id='t'/>\
            <arc id='a' source='p' target='t'><name><text>3</text></name></arc> | \
            x:2: arc a is called "3" and has no <inscription>, expected one if that is its weight
            <place id='p'><initialMarking><text>9223372036854775808</text></initialMarking></place> | \
            x:2: the initial marking of place p is "9223372036854775808", \
            expected a whole number from 0 to 9223372036854775807
            <place id='p'/>~<referencePlace id='r' ref='gone'/> | \
            x:3: there is no place or transition with id gone
            <referencePlace id='r' ref='s'/>~<referencePlace id='s' ref='r'/> | x:2: reference r refers to itself
            """)
    void fileOfAnotherTool_thatMeansMore_isRefused(String body, String message) {
        assertRefused(STANDARD, body.replace('~', '\n')).hasMessage(message);
    }

    @Test
    void normalArcsAndEqualPriorities_ofAnotherTool_areRead() {
        var priority = "<transition id='%s'><priority><value>1</value></priority></transition>";
        assertThat(read(STANDARD, NODES + "<arc id='a' source='p' target='t' type='normal'/>")
                        .arcCount())
                .isEqualTo(1);
        assertThat(warnings).isEmpty();
        assertThat(read(STANDARD, priority.formatted("t") + priority.formatted("u"))
                        .transitions())
                .hasSize(2);
    }

    /** Read as an ordinary arc, an inhibitor arc would change the dead markings. */
    @ParameterizedTest
    @ValueSource(
            strings = {
                "<arc id='a' source='p' target='t' type='inhibitor'><inscription><text>3</text></inscription></arc>",
                "<arc id='a' source='p' target='t'><inscription><text>3</text></inscription><type value='inhibitor'/></arc>",
                "<arc id='a' source='p' target='t'><inscription><text>3</text></inscription>"
                        + "<arctype><text>inhibitor</text></arctype></arc>"
                        + "<arc id='b' source='p' target='t'><type><text>inhibitor</text></type>"
                        + "<inscription><text>4</text></inscription></arc>"
            })
    void inhibitorArc_inEachNotation_isReadWithItsWeight(String arc) {
        var net = read(STANDARD, NODES + arc);
        assertThat(net.structure()).isEqualTo("place p 0\ntransition t 0 [] -> [] unless [p*3]");
        assertThat(warnings).isEmpty();
    }

    @Test
    void inhibitorArc_isWrittenInAllNotations() {
        var net = PetriNet.builder("guarded")
                .place("p", 1)
                .transition("t")
                .inhibitor("p", "t", 2)
                .build();
        assertThat(Pnml.toText(net)).isEqualTo("""
            <?xml version="1.0" encoding="UTF-8"?>
            <pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml">
              <net id="guarded" type="http://www.pnml.org/version-2009/extensions/inhibitorptnet">
                <name><text>guarded</text></name>
                <page id="page">
                  <place id="p"><name><text>p</text></name><initialMarking><text>1</text></initialMarking></place>
                  <transition id="t"><name><text>t</text></name></transition>
                  <arc id="a1" source="p" target="t" type="inhibitor"><inscription><text>2</text></inscription>\
            <type value="inhibitor"/><arctype><text>inhibitor</text></arctype></arc>
                </page>
              </net>
            </pnml>
            """);
        assertThat(Pnml.parse("x", Pnml.toText(net)).sameStructureAs(net)).isTrue();
    }

    @Test
    void document_ofAnotherKind_isRefused() {
        assertRefused("<html/>")
                .hasMessageStartingWith("x:1: the root element is <html> in namespace \"\", expected <pnml>");
        assertRefused(PNML + "\n<net id='n' type='symmetricnet'/></pnml>")
                .hasMessageStartingWith("x:2: net n is of type \"symmetricnet\", expected");
        assertRefused("<pnml xmlns='urn:other'><net id='n' type='ptnet'/></pnml>")
                .hasMessageStartingWith("x:1: the root element is <pnml> in namespace \"urn:other\"");
        assertRefused(PNML + "</pnml>").hasMessage("x:1: there is no <net>");
        assertRefused("").hasMessageStartingWith("x:1: ");
        assertRefused(STANDARD.split("\n")[0]).hasMessageStartingWith("x:");
        assertRefused(STANDARD, "<page id='x'>".repeat(60) + "</page>".repeat(60))
                .hasMessageStartingWith("x:2: ")
                .hasMessageContaining("pages are nested deeper than 50")
                .hasMessageNotContaining("\n");
    }

    @Test
    void entity_inDocument_opensNoFile() throws IOException {
        var secret = Files.writeString(directory.resolve("secret.txt"), "7");
        var doctype = "\n<!DOCTYPE pnml [<!ENTITY secret SYSTEM \"" + secret.toUri() + "\">]>\n";
        var body = "<place id='p'><initialMarking><text>&secret;</text></initialMarking></place>";
        assertRefused("%s" + STANDARD, doctype, body).hasMessage("x:2: a document type declaration is not accepted");
        assertRefused(STANDARD, body).hasMessageContaining("secret");
    }

    @Test
    void file_missingOrUnreadableOrUnwritable_isNamed_andNothingIsPrinted() throws IOException {
        var garbage = Files.write(directory.resolve("bad.pnml"), new byte[] {'<', 'a', '>', '\n', (byte) 0xff, '<'});
        var printed = new ByteArrayOutputStream();
        var standardError = System.err;
        System.setErr(new PrintStream(printed, true, UTF_8));
        try {
            assertThatThrownBy(() -> Pnml.read(garbage))
                    .isInstanceOf(PnmlException.class)
                    .hasMessageStartingWith(garbage + ":")
                    .hasMessageEndingWith("the file is not in UTF-8, which it names as its encoding or by naming none");
        } finally {
            System.setErr(standardError);
        }
        assertThat(printed.toString(UTF_8)).isEmpty();
        var encoding = Files.writeString(garbage, "<?xml version='1.0' encoding='bogus'?><pnml/>");
        assertThatThrownBy(() -> Pnml.read(encoding)).hasMessage(encoding + ":1: Invalid encoding name \"bogus\".");
        var missing = directory.resolve("missing.pnml");
        assertThatThrownBy(() -> Pnml.read(missing))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith(missing + ": cannot be read: ");
        assertThatThrownBy(() -> Pnml.write(PaperNets.robot(), directory)).hasMessage("cannot write " + directory);
    }

    @Test
    void otherEncodings_areReadAsDeclared() throws IOException {
        var text = STANDARD.formatted("<place id='\u00e9'/>");
        var utf16 = Files.write(directory.resolve("16.pnml"), text.getBytes(UTF_16));
        var marked = Files.writeString(directory.resolve("8.pnml"), "\ufeff" + text);
        var declared = "<?xml version='1.0' encoding='ISO-8859-1'?>" + text;
        var latin = Files.write(directory.resolve("1.pnml"), declared.getBytes(ISO_8859_1));
        assertThat(List.of(utf16, marked, latin))
                .allSatisfy(file -> assertThat(Pnml.read(file).places()).hasToString("[\u00e9]"));
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "http://www.informatik.hu-berlin.de/top/pnml/basicPNML.rng",
                "http://www.informatik.hu-berlin.de/top/pntd/ptNetb",
                "http://www.pnml.org/version-2009/grammar/pnmlcoremodel",
                "P/T net",
                "PTNet"
            })
    void plainNet_ofAnotherTypeWithoutNamespaceAndPages_isReadWithWarnings(String type) {
        var net = read(OPEN, type, """
                <place id='p'><name><text>full</text></name><initialMarking><text>2</text></initialMarking></place>
                <transition id='t'/><arc id='a' source='p' target='t'/>""");
        assertThat(net.structure()).isEqualTo("place full 2\ntransition t 0 [full*1] -> []");
        assertThat(warnings)
                .containsExactly(
                        "x:1: the namespace is \"\", not that of the standard",
                        "x:1: net n is of type \"" + type + "\", read as a place/transition net",
                        "x:2: <place> stands in the net itself, not in a <page>");
    }

    @Test
    void netInTheNamespaceBeforeTheStandard_isRead() {
        var before = "<pnml xmlns='http://www.informatik.hu-berlin.de/top/pnml/ptNetb'>%s</pnml>";
        assertThat(read(before, "<net id='n' type='ptNetb'>" + NODES + "</net>").places())
                .hasSize(1);
    }

    /** As PIPE writes it: values with a colour, capacities, rates and orientations without an effect. */
    @Test
    void netOfPipe_isRead() {
        var net = read(OPEN, "P/T net", """
            <token id="Default" enabled="true" red="0" green="0" blue="0"/>
            <place id="P0"><graphics/><name><value>P0</value></name><capacity><value>0</value></capacity>
              <initialMarking><value>Default,3</value><graphics/></initialMarking>
              <tagged><value>false</value></tagged></place>
            <transition id="T0"><orientation><value>0</value></orientation><rate><value>1.0</value></rate>
              <timed><value>false</value></timed><infiniteServer><value>false</value></infiniteServer>
              <priority><value>1</value></priority></transition>
            <arc id="P0 to T0" source="P0" target="T0"><inscription><value>Default,2</value></inscription>
              <tagged><value>false</value></tagged><arcpath id="000" x="1" y="1" curvePoint="false"/>
              <type value="normal"/></arc>
            <stategroup name="G1" id="SG1"><statecondition condition="P0 &gt; 0"/></stategroup>
            """);
        assertThat(net.structure()).isEqualTo("place P0 3\ntransition T0 0 [P0*2] -> []");
        assertRefused(OPEN, "P/T net", "<token id='Default'/>\n<token id='Red'/>")
                .hasMessage("x:3: tokens have a second colour, Red; expected one, Default");
    }

    @Test
    void netOfProM_withArcTypesAndFinalMarkings_isRead() {
        var net = read(OPEN, "http://www.pnml.org/version-2009/grammar/pnmlcoremodel", """
                <name/><page id='n0'><place id='p'/><transition id='t'/><arc id='a' source='p' target='t'>\
                <name><text>1</text></name><arctype><text>normal</text></arctype></arc></page>
                <finalmarkings><marking><place idref='p'><text>0</text></place></marking></finalmarkings>""");
        assertThat(net.arcCount()).isEqualTo(1);
        assertThat(warnings).anyMatch(warning -> warning.startsWith("x:3: final markings are left out"));
    }

    @Test
    void idsOfArcs_thatAreRepeatedOrMissing_areReadWithAWarning() {
        var net = read(STANDARD, NODES + """

                <arc id='a' source='p' target='t'/>
                <arc id='a' source='t' target='p'/>
                <arc source='t' target='p'/><arc id='t' source='t' target='p'/>""");
        assertThat(net.structure()).isEqualTo("place p 0\ntransition t 0 [p*1] -> [p*3]");
        assertThat(warnings).containsExactly("x:4: id a of an arc is used twice", "x:5: arc t -> p has no id");
    }
}
