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
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Files of other tools: read with a warning if they contain a plain net, otherwise rejected. */
class PnmlOfOtherToolsTest {
    private static final String STANDARD = "<pnml xmlns='" + Pnml.NAMESPACE + "'><net id='n' type='" + Pnml.NET_TYPE
            + "'><page id='g'>\n%s\n</page></net></pnml>";
    private static final String OPEN = "<pnml><net id='n' type='%s'>\n%s\n</net></pnml>";
    private static final String NODES = "<place id='p'/><transition id='t'/>";

    private final List<String> warnings = new ArrayList<>();

    private PetriNet read(String form, Object... parts) {
        return Pnml.parse("other.pnml", form.formatted(parts), warnings::add);
    }

    private void assertRefused(String body, int line, String reason) {
        assertThatThrownBy(() -> read(STANDARD, body))
                .isInstanceOf(PnmlException.class)
                .hasMessage("other.pnml:" + line + ": " + reason);
    }

    /** As TAPAAL writes it: read as an ordinary arc, it would change which markings are dead. */
    @Test
    void inhibitorArc_asAnAttribute_isRefusedWithItsLine() {
        assertRefused(
                NODES + "\n<arc id='a' source='p' target='t' type='inhibitor'/>",
                3,
                "type of <arc> a is \"inhibitor\", expected normal in a place/transition net");
        assertRefused(
                NODES + "<arc id='a' source='p' target='t'><arctype><text>reset</text></arctype></arc>",
                2,
                "arctype of arc a is \"reset\"" + ", expected normal in a place/transition net");
        assertThat(read(STANDARD, NODES + "<arc id='a' source='p' target='t' type='normal'/>")
                        .arcCount())
                .isEqualTo(1);
        assertThat(warnings).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            <place id='p' initialMarking='1'/>             | attribute initialMarking="1" of <place> p
            <place id='p' capacity='1'/>                   | capacity of <place> p is "1", expected 0 or Default,0
            <place id='p'><capacity><value>2</value></capacity></place> | capacity of place p is "2"
            <transition id='t' urgent='true'/>             | urgent of <transition> t is "true", expected false
            <transition id='t' x:guard='1' xmlns:x='urn:y'/> | attribute guard="1" of <transition> t
            <transition id='t'><timed><value>true</value></timed></transition><transition id='u'/> | 1 of 2 transitions
            <transition id='t'><rate><value>0.0</value></rate></transition> | <rate> of transition t is "0.0"
            <place id='p'><initialMarking scale='2'><text>1</text></initialMarking></place> | scale="2" of <initialMarking>
            <place id='p'><initialMarking><text>1</text><text>2</text></initialMarking></place> | a second <text>
            <place id='p'><initialMarking><text>1</text></initialMarking><initialMarking/></place> | a second <initialMarking> in place p
            <x:place id='p' xmlns:x='urn:coloured'/>       | <place> is of namespace "urn:coloured"
            <referencePlace id='r' ref='r'><initialMarking/></referencePlace> | <initialMarking> in reference r
            """)
    void whatMayChangeTheMeaning_isRefused(String body, String reason) {
        assertThatThrownBy(() -> read(STANDARD, body))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith("other.pnml:")
                .hasMessageContaining(reason);
    }

    @Test
    void prioritiesOfAnotherTool_thatDiffer_areRefused() {
        var form = "<transition id='t'><priority><value>1</value></priority></transition>\n"
                + "<transition id='u'><priority><value>%s</value></priority></transition>";

        assertRefused(
                form.formatted(2),
                3,
                "<priority> of transition u is \"2\", that of another is \"1\", expected the same for all transitions"
                        + " of a place/transition net");
        assertThat(read(STANDARD, form.formatted(1)).transitions()).hasSize(2);
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
        var net = read(
                OPEN,
                type,
                "<place id='p'><name><text>full</text></name><initialMarking><text>2</text></initialMarking></place>\n"
                        + "<transition id='t'/><arc id='a' source='p' target='t'/>");

        assertThat(net.structure()).isEqualTo("place full 2\ntransition t 0 [full*1] -> []");
        assertThat(warnings)
                .containsExactly(
                        "other.pnml:1: the namespace is \"\", not that of the standard",
                        "other.pnml:1: net n is of type \"" + type + "\", read as a place/transition net",
                        "other.pnml:2: <place> stands in the net itself, not in a <page>");
    }

    @Test
    void netInTheNamespaceBeforeTheStandard_isRead() {
        assertThat(read("<pnml xmlns='http://www.informatik.hu-berlin.de/top/pnml/ptNetb'><net id='n' type='ptNetb'>"
                                + NODES + "</net></pnml>")
                        .places())
                .hasSize(1);
        assertThatThrownBy(() -> read("<pnml xmlns='urn:other'><net id='n' type='ptnet'/></pnml>"))
                .hasMessageStartingWith("other.pnml:1: the root element is <pnml> in namespace \"urn:other\"");
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
        assertThatThrownBy(() -> read(OPEN, "P/T net", "<token id='Default'/>\n<token id='Red'/>"))
                .hasMessage("other.pnml:3: tokens have a second colour, Red; expected one, Default");
        assertRefused(
                "<place id='p'><tagged><value>true</value></tagged></place>",
                2,
                "tagged of place p is \"true\", expected false in a place/transition net");
    }

    @Test
    void netOfProM_withArcTypesAndFinalMarkings_isRead() {
        var net = read(
                OPEN,
                "http://www.pnml.org/version-2009/grammar/pnmlcoremodel",
                "<name/><page id='n0'>" + NODES
                        + "<arc id='a' source='p' target='t'><name><text>1</text></name>"
                        + "<arctype><text>normal</text></arctype></arc></page>\n"
                        + "<finalmarkings><marking><place idref='p'><text>0</text></place></marking></finalmarkings>");

        assertThat(net.arcCount()).isEqualTo(1);
        assertThat(warnings)
                .anySatisfy(warning -> assertThat(warning).startsWith("other.pnml:3: final markings are left out"));
        assertRefused(
                NODES + "<arc id='a' source='p' target='t'><name><text>3</text></name></arc>",
                2,
                "arc a is called \"3\" and has no <inscription>, expected one if that is its weight");
    }

    @Test
    void idsOfArcs_thatAreRepeatedOrMissing_areReadWithAWarning() {
        var net = read(
                STANDARD,
                NODES + "\n<arc id='a' source='p' target='t'/>\n<arc id='a' source='t' target='p'/>\n"
                        + "<arc source='t' target='p'/><arc id='t' source='t' target='p'/>");

        assertThat(net.structure()).isEqualTo("place p 0\ntransition t 0 [p*1] -> [p*3]");
        assertThat(warnings)
                .containsExactly("other.pnml:4: id a of an arc is used twice", "other.pnml:5: arc t -> p has no id");
    }

    @Test
    void tooManyTokens_areRefusedByTheLimit() {
        assertRefused(
                "<place id='p'><initialMarking><text>4000000000</text></initialMarking></place>",
                2,
                "the initial marking of place p is \"4000000000\", expected a whole number from 0 to 2147483647");
    }

    @Test
    void referenceToNowhere_isRefusedAlthoughNoArcUsesIt() {
        assertRefused(
                "<place id='p'/>\n<referencePlace id='r' ref='gone'/>",
                3,
                "there is no place or transition with id gone");
        assertRefused(
                "<referencePlace id='r' ref='s'/>\n<referencePlace id='s' ref='r'/>",
                2,
                "reference r refers to itself");
    }

    @Test
    void bytesThatAreNoUtf8_areRefusedAndNothingIsPrinted(@TempDir Path directory) throws IOException {
        var file = Files.write(directory.resolve("bad.pnml"), new byte[] {'<', 'a', '>', '\n', (byte) 0xff, '<'});
        var printed = new ByteArrayOutputStream();
        var standardError = System.err;
        System.setErr(new PrintStream(printed, true, UTF_8));
        try {
            assertThatThrownBy(() -> Pnml.read(file))
                    .isInstanceOf(PnmlException.class)
                    .hasMessageEndingWith("the file is not in UTF-8, as it says or does not deny");
        } finally {
            System.setErr(standardError);
        }
        assertThat(printed.toString(UTF_8)).isEmpty();
    }

    @Test
    void otherEncodings_areReadAsDeclared(@TempDir Path directory) throws IOException {
        var text = STANDARD.formatted("<place id='\u00e9'/>");
        var utf16 = Files.write(directory.resolve("16.pnml"), text.getBytes(UTF_16));
        var marked = Files.writeString(directory.resolve("8.pnml"), "\ufeff" + text);
        var latin = Files.write(
                directory.resolve("1.pnml"),
                ("<?xml version='1.0' encoding='ISO-8859-1'?>" + text).getBytes(ISO_8859_1));

        for (var file : List.of(utf16, marked, latin)) {
            assertThat(Pnml.read(file).places()).extracting(Place::name).containsExactly("\u00e9");
        }
    }
}
