package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatExceptionOfType;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.tools.Thorough;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Nets with more tokens than an int, and their firing rule beside that of a {@link PetriNet}. */
class LargeNetTest {
    private static final long LAKE = 4_000_000_000L;

    @TempDir
    Path directory;

    private static LargeNet large(PetriNet net, String place, long tokens) {
        return LargeNet.of(net, Map.of(net.place(place), tokens));
    }

    private static List<Transition> trace(LargeNet large, String... names) {
        return List.of(names).stream().map(large.net()::transition).toList();
    }

    private Path file(String body) throws IOException {
        return Files.writeString(
                directory.resolve("lake.pnml"),
                "<pnml xmlns='" + Pnml.NAMESPACE + "'><net id='n' type='" + Pnml.NET_TYPE + "'><page id='g'>\n" + body
                        + "</page></net></pnml>");
    }

    private static String place(String id, String name, String tokens) {
        return "<place id='" + id + "'><name><text>" + name + "</text></name><initialMarking><text>" + tokens
                + "</text></initialMarking></place>\n";
    }

    @Test
    void file_withMoreTokensThanAnInt_isReadWithItsTrueTokens() throws IOException {
        var large = Pnml.readLarge(
                file(place("p1", "lake", "4000000000")
                        + place("p2", "sea", "9223372036854775807")
                        + place("p3", "pond", "2147483647")
                        + place("p4", "puddle", "2")),
                warning -> {});
        assertThat(large.largePlaces()).hasToString("[lake, sea]");
        assertThat(large.initialMarking())
                .hasToString("{4000000000*lake, 9223372036854775807*sea, 2147483647*pond, 2*puddle}");
        assertThat(large.initialMarking().tokens(large.net().place("lake"))).isEqualTo(LAKE);
        assertThat(large.withoutLargePlaces().initialMarking()).hasToString("{2147483647*pond, 2*puddle}");
    }

    /** Without distinct names the places are called by their ids. */
    @Test
    void file_withoutDistinctNames_hasItsLargePlaceById() throws IOException {
        var large = Pnml.readLarge(file(place("p1", "lake", "3") + place("p2", "lake", "3000000000")), warning -> {});
        assertThat(large.largePlaces()).hasToString("[p2]");
        assertThat(large.initialMarking()).hasToString("{3*p1, 3000000000*p2}");
    }

    @Test
    void file_withFewTokens_hasNoLargePlaces() throws IOException {
        var file = file(place("p1", "lake", "2147483647") + "<transition id='t'/><arc id='a' source='p1' target='t'/>");
        var large = Pnml.readLarge(file, warning -> {});
        assertThat(large.largePlaces()).isEmpty();
        assertThat(large.net().sameStructureAs(Pnml.read(file))).isTrue();
        assertThat(large.withoutLargePlaces().sameStructureAs(large.net())).isTrue();
    }

    @Test
    void numbers_beyondALong_andWeightsBeyondAnInt_areRefusedWithTheirLine() throws IOException {
        var tooMany = file(place("p1", "lake", "9223372036854775808"));
        assertThatThrownBy(() -> Pnml.readLarge(tooMany, warning -> {}))
                .isInstanceOf(PnmlException.class)
                .hasMessage(tooMany + ":2: the initial marking of place p1 is \"9223372036854775808\","
                        + " expected a whole number from 0 to 9223372036854775807");
        var heavy = file(place("p1", "lake", "4000000000") + "<transition id='t'/>\n<arc id='a' source='p1' target='t'>"
                + "<inscription><text>4000000000</text></inscription></arc>");
        assertThatThrownBy(() -> Pnml.readLarge(heavy, warning -> {}))
                .hasMessage(heavy + ":4: the weight of arc a is \"4000000000\","
                        + " expected a whole number from 1 to 2147483647");
        var ordinary = file(place("p1", "lake", "4000000000"));
        assertThatThrownBy(() -> Pnml.read(ordinary))
                .hasMessage(ordinary + ":2: the initial marking of place p1 is \"4000000000\","
                        + " expected a whole number from 0 to 2147483647; Pnml.readLarge reads more");
    }

    @Test
    void firings_countTokensBeyondAnInt() {
        var large = large(
                Nets.net("n", "lake n=3", "drain: n 2000000000*lake >", "fill: n > 1000000000*lake"), "lake", LAKE);
        assertThat(large.after(trace(large, "drain", "fill", "drain")))
                .hasValueSatisfying(end -> assertThat(end).hasToString("{1000000000*lake}"));
        assertThat(large.after(trace(large, "fill", "fill", "fill"))).hasValueSatisfying(end -> {
            assertThat(end).hasToString("{7000000000*lake}");
            assertThat(large.enabled(end)).isEmpty();
        });
        assertThat(large.after(trace(large, "drain", "drain", "drain"))).isEmpty();
        assertThat(large.after(trace(large, "fill", "fill", "fill", "fill"))).isEmpty();
        assertThat(large.enabled(large.initialMarking())).hasToString("[drain, fill]");

        var full = large(Nets.net("n", "lake", "fill: > 2*lake"), "lake", Long.MAX_VALUE - 3);
        assertThat(full.after(trace(full, "fill"))).isPresent();
        assertThatExceptionOfType(ArithmeticException.class)
                .isThrownBy(() -> full.after(trace(full, "fill", "fill")))
                .withMessage("place lake would hold more than 9223372036854775807 tokens");
    }

    @Test
    void netWithoutLargePlaces_leavesOutWhatTheyInhibit() {
        var net = Nets.net("n", "lake p=1 q", "a: p > q lake", "b: q lake > p", "c: q > p").toBuilder()
                .inhibitor("lake", "c", 5)
                .inhibitor("p", "b")
                .priority("a", 2)
                .build();
        assertThat(large(net, "lake", 5).withoutLargePlaces().structure())
                .isEqualTo("place p 1\nplace q 0\ntransition a 2 [p*1] -> [q*1]\ntransition b 0 [q*1] -> [p*1] unless"
                        + " [p*1]");
        assertThat(large(net, "lake", 4).withoutLargePlaces().structure()).endsWith("transition c 0 [q*1] -> [p*1]");
    }

    @Test
    void strangers_areRefused() {
        var net = Nets.net("n", "lake p=1", "t: p >");
        var other = Nets.net("other", "lake sea", "t: lake >");
        var large = large(net, "lake", LAKE);
        assertThat(Nets.refusals(
                        () -> large(net, "lake", -1),
                        () -> LargeNet.of(net, Map.of(other.place("sea"), LAKE)),
                        () -> large.initialMarking().tokens(other.place("sea")),
                        () -> large.enabled(large(other, "sea", LAKE).initialMarking()),
                        () -> large.after(other.transitions())))
                .isEqualTo("""
                        place lake has -1 tokens, expected 0 or more
                        places [sea] are not of net n
                        place sea is not of the net this marking belongs to
                        marking {4000000000*sea} is of a net with other places than n
                        transition t is another one in net n""");
        assertThat(large).hasToString("n (2 places, 1 transitions, 1 arcs) with large places {lake=4000000000}");
        assertThat(large.initialMarking())
                .isEqualTo(large(net, "lake", LAKE).initialMarking())
                .hasSameHashCodeAs(large(net, "lake", LAKE).initialMarking())
                .isNotEqualTo(large(net, "lake", LAKE + 1).initialMarking());
    }

    /** Random walks, also with inhibitor arcs and priorities, beside those of a net that counts in int. */
    @Test
    void firingRule_isThatOfANetWithFewTokens() {
        var firings = 0;
        for (var seed = 1L; seed <= Thorough.times(100, 500); seed++) {
            var random = new Random(seed);
            var net = seed % 2 == 0 ? Nets.inhibited(Nets.any(random), random) : Nets.parts(2, random);
            var first = net.places().getFirst();
            var large = LargeNet.of(net, Map.of(first, (long) first.tokens()));
            var marking = net.initialMarking();
            var trace = new ArrayList<Transition>();
            for (var i = 0; i < 20; i++) {
                var now = large.after(trace).orElseThrow();
                assertThat(now).as("seed %d", seed).hasToString(marking.toString());
                var enabled = net.enabled(marking);
                assertThat(large.enabled(now)).as("seed %d", seed).isEqualTo(enabled);
                for (var t : net.transitions()) {
                    trace.add(t);
                    assertThat(large.after(trace).isPresent())
                            .as("seed %d: %s", seed, trace)
                            .isEqualTo(enabled.contains(t));
                    trace.removeLast();
                }
                if (enabled.isEmpty()) {
                    break;
                }
                trace.add(enabled.get(random.nextInt(enabled.size())));
                marking = net.fire(marking, trace.getLast());
                firings++;
            }
        }
        assertThat(firings).isGreaterThan(Thorough.times(300, 3_000));
    }
}
