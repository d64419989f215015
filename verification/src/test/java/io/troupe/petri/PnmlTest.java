package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

class PnmlTest {
    private static final String HEAD = """
        <?xml version="1.0"?>
        <pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml">
        <net id="n" type="http://www.pnml.org/version-2009/grammar/ptnet">
        <page id="page">
        """;
    private static final String TAIL = "</page></net></pnml>";

    private static PetriNet page(String body) {
        return Pnml.parse("test.pnml", HEAD + body + TAIL);
    }

    @ParameterizedTest
    @EnumSource
    void file_writtenAndReadBack_isTheSameNet(PaperNets.Reading reading, @TempDir Path directory) {
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
        var net = PetriNet.builder("a < b & \"c\" ]]>")
                .place("1st", 7)
                .place("_st")
                .place("_1st")
                .place("\u00e9t\u00e9 \ud83e\udd16")
                .place("page")
                .place("a1")
                .transition("go & <b>'go'</b>", List.of("page"), List.of("_st", "a1"))
                .arc("1st", "go & <b>'go'</b>", 3)
                .priority("go & <b>'go'</b>", Integer.MIN_VALUE)
                .build();

        var back = Pnml.parse("text", Pnml.toText(net));

        assertThat(back.name()).isEqualTo(net.name());
        assertThat(back.structure()).isEqualTo(net.structure());
    }

    @Test
    void page_withEverythingAPtNetMayHold_isRead() {
        var net = page("""
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
        var net = page("<place id='p1'><name><text>x</text></name></place><transition"
                + " id='t1'><name><text>x</text></name></transition><place id='x'/>");

        assertThat(net.places()).extracting(Place::name).containsExactly("p1", "x");
        assertThat(net.transitions()).extracting(Transition::name).containsExactly("t1");
    }

    @Test
    void badFile_isRefusedWithLineAndReason() {
        refused("<place id='p'/>\n<place id='p'/>", 6, "id p is used twice");
        refused("<place/>", 5, "<place> has no id");
        refused(
                "\n<place id='p'><initialMarking><text>-1</text></initialMarking></place>",
                6,
                "the initial marking of place p is \"-1\", expected a whole number from 0 to 2147483647");
        refused(
                "<place id='p'><initialMarking><text>99999999999</text></initialMarking></place>",
                5,
                "is \"99999999999\", expected a whole number from 0 to 2147483647");
        refused("<place id='p'><initialMarking/></place>", 5, "the initial marking of place p is \"\"");
        refused(
                "<place id='p'/><transition id='t'/>\n"
                        + "<arc id='a' source='p' target='t'>\n"
                        + "<inscription><text>0</text></inscription></arc>",
                7,
                "the weight of arc a is \"0\", expected a whole number from 1 to 2147483647");
        refused("<place id='p'/>\n<place id='q'/>\n<arc id='a' source='p' target='q'/>", 7, "joins two places");
        refused(
                "<place id='p'/>\n<arc id='a' source='p' target='gone'/>",
                6,
                "there is no place or transition with id gone");
        refused("<place id='p'/>\n<arc id='a' source='p'/>", 6, "<arc> has no target");
        refused(
                "<place id='p'/><transition id='t'/>\n"
                        + "<arc id='a' source='p' target='t'><type value='inhibitor'/></arc>",
                6,
                "type of arc a is \"inhibitor\", expected normal in a place/transition net");
        refused(
                "<transition id='t'><initialMarking><text>1</text></initialMarking></transition>",
                5,
                "<initialMarking> in transition t");
        refused(
                "<referencePlace id='r' ref='s'/>\n"
                        + "<referencePlace id='s' ref='r'/>\n"
                        + "<arc id='a' source='r' target='r'/>",
                5,
                "reference r refers to itself");
        refused(
                "<transition id='t'/>\n<referencePlace id='r' ref='t'/>\n<arc id='a' source='r' target='t'/>",
                6,
                "a reference to a place names t, which is none");
        refused("<page id='x'>".repeat(60) + "</page>".repeat(60), 5, "pages are nested deeper than 50");
        refused("<place id='p'>\n</plaice>", 6, "the matching end-tag \"</place>\"");
        refused("stray text", 5, "");
        var most = "<arc id='%s' source='p' target='t'><inscription><text>2147483647</text></inscription></arc>";
        refused(
                "<place id='p'/><transition id='t'/>" + most.formatted("a") + "\n" + most.formatted("b"),
                6,
                "the arcs from p to t weigh 4294967294 together, expected at most 2147483647");
    }

    private static void refused(String body, int line, String reason) {
        assertThatThrownBy(() -> page(body))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith("test.pnml:" + line + ": ")
                .hasMessageContaining(reason)
                .hasMessageNotContaining("\n");
    }

    @Test
    void document_ofAnotherKind_isRefused() {
        assertThatThrownBy(() -> Pnml.parse("x", "<html/>"))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith("x:1: the root element is <html> in namespace \"\", expected <pnml>");
        assertThatThrownBy(() -> Pnml.parse(
                        "x", "<pnml xmlns='" + Pnml.NAMESPACE + "'>\n<net id='n' type='symmetricnet'/></pnml>"))
                .hasMessageStartingWith("x:2: net n is of type \"symmetricnet\", expected");
        assertThatThrownBy(() -> Pnml.parse("x", "<pnml xmlns='" + Pnml.NAMESPACE + "'/>"))
                .hasMessage("x:1: there is no <net>");
        assertThatThrownBy(() -> Pnml.parse("x", ""))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith("x:1: ");
        assertThatThrownBy(() -> Pnml.parse("x", HEAD))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith("x:");
    }

    @Test
    void entity_inDocument_opensNoFile(@TempDir Path directory) throws IOException {
        var secret = Files.writeString(directory.resolve("secret.txt"), "7");
        var doctype = "<!DOCTYPE pnml [<!ENTITY secret SYSTEM \"" + secret.toUri() + "\">]>\n";
        var body = "<place id='p'><initialMarking><text>&secret;</text></initialMarking></place>";

        assertThatThrownBy(() ->
                        Pnml.parse("x", "\n" + doctype + HEAD.lines().skip(1).reduce("", String::concat) + body + TAIL))
                .isInstanceOf(PnmlException.class)
                .hasMessage("x:2: a document type declaration is not accepted");
        assertThatThrownBy(() -> page(body)).isInstanceOf(PnmlException.class).hasMessageContaining("secret");
    }

    @Test
    void file_missingOrUnreadableOrUnwritable_isNamed(@TempDir Path directory) throws IOException {
        var garbage =
                Files.write(directory.resolve("garbage.pnml"), new byte[] {'<', 'a', '>', '\n', (byte) 0xff, '<'});
        assertThatThrownBy(() -> Pnml.read(garbage))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith(garbage + ":");
        var encoding = Files.writeString(garbage, "<?xml version='1.0' encoding='bogus'?><pnml/>");
        assertThatThrownBy(() -> Pnml.read(encoding)).hasMessage(encoding + ":1: Invalid encoding name \"bogus\".");
        var missing = directory.resolve("missing.pnml");

        assertThatThrownBy(() -> Pnml.read(missing))
                .isInstanceOf(PnmlException.class)
                .hasMessageStartingWith(missing + ": cannot be read: ");
        assertThatThrownBy(() -> Pnml.write(PaperNets.robot(), directory)).hasMessage("cannot write " + directory);
    }
}
