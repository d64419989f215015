package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.List;
import org.junit.jupiter.api.Test;

class PetriNetTest {
    /** Two parts and a wheel make a cart; carts are sold one by one. */
    private static PetriNet workshop() {
        return PetriNet.builder("workshop")
                .place("parts", 5)
                .place("wheels", 2)
                .place("carts")
                .transition("make", List.of("wheels"), List.of("carts"))
                .arc("parts", "make", 2)
                .transition("sell", List.of("carts"), List.of())
                .build();
    }

    @Test
    void net_built_keepsOrderTokensAndWeights() {
        var net = workshop();

        assertThat(net).hasToString("workshop (3 places, 2 transitions, 4 arcs)");
        assertThat(net.places()).extracting(Place::name).containsExactly("parts", "wheels", "carts");
        assertThat(net.transition("make").inputs())
                .containsExactly(new Arc(net.place("wheels"), 1), new Arc(net.place("parts"), 2));
        assertThat(net.initialMarking()).hasToString("{5*parts, 2*wheels}");
    }

    @Test
    void fire_enabled_movesTokensByWeight() {
        var net = workshop();

        var after = net.fire(net.initialMarking(), net.transition("make"));

        assertThat(after).isEqualTo(net.marking("parts", "parts", "parts", "wheels", "carts"));
        assertThat(net.enabled(after)).containsExactly(net.transition("make"), net.transition("sell"));
        assertThat(net.initialMarking().tokens(net.place("parts"))).isEqualTo(5);
    }

    @Test
    void fire_notEnabled_tellsWhatIsMissing() {
        var net = workshop();

        assertThatThrownBy(() -> net.fire(net.marking("parts"), net.transition("make")))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("transition make may not fire in {parts}: wheels holds 0 of 1, parts holds 1 of 2");
    }

    @Test
    void fire_outranked_tellsWhoGoesFirst() {
        var net = workshop().toBuilder().priority("sell", 3).build();
        var marking = net.marking("parts", "parts", "wheels", "carts");

        assertThat(net.enabled(marking)).containsExactly(net.transition("sell"));
        assertThatThrownBy(() -> net.fire(marking, net.transition("make")))
                .hasMessageEndingWith("sell has priority 3 over 0");
        assertThat(net.enabled(net.initialMarking())).containsExactly(net.transition("make"));
    }

    @Test
    void fire_placeOverflowing_isRefused() {
        var net = PetriNet.builder("flood")
                .place("lake", Integer.MAX_VALUE)
                .transition("rain", List.of(), List.of("lake"))
                .build();

        assertThatThrownBy(() -> net.fire(net.initialMarking(), net.transition("rain")))
                .isInstanceOf(ArithmeticException.class)
                .hasMessage("place lake would hold 2147483648 tokens, more than 2147483647");
        assertThatThrownBy(() -> ReachabilityGraph.explore(net))
                .hasMessageContaining("place lake would hold 2147483648");
    }

    @Test
    void builder_badInput_namesNetThingAndValue() {
        var net = workshop().toBuilder();

        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.place("make"))
                .withMessage("net workshop: make is already the name of a transition");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.transition("parts"))
                .withMessage("net workshop: parts is already the name of a place");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.place("nails", -1))
                .withMessage("net workshop: place nails has -1 tokens, expected 0 or more");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.arc("wheels", "sell", 0))
                .withMessage("net workshop: arc wheels -> sell has weight 0, expected 1 or more");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.arc("wheels", "burn"))
                .withMessage("net workshop: arc wheels -> burn: there is no place or transition called burn");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.arc("wheels", "parts"))
                .withMessage("net workshop: arc wheels -> parts joins two places, expected a place and a transition");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.arc("parts", "make"))
                .withMessage("net workshop: arc parts -> make is there already; give it a weight instead");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.transition("burn", List.of("wood"), List.of()))
                .withMessage("net workshop: transition burn: there is no place called wood");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.transition("burn", List.of("carts", "carts"), List.of()))
                .withMessageContaining("names place carts twice");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.remove("burn"))
                .withMessage("net workshop: there is no transition called burn");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.place(" "))
                .withMessageContaining("a name is \" \", expected text");
        assertThat(net.build().sameStructureAs(workshop())).isTrue();
    }

    @Test
    void lookup_unknownOrForeign_isRefused() {
        var net = workshop();
        var other = PetriNet.builder("other")
                .place("x")
                .transition("go", List.of("x"), List.of())
                .build();

        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.place("make"))
                .withMessage("net workshop has no place called make");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.fire(net.initialMarking(), other.transition("go")))
                .withMessage("transition go is not of net workshop");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.enabled(other.initialMarking()))
                .withMessageContaining("is of a net with other places than workshop");
        assertThatIllegalArgumentException()
                .isThrownBy(() -> net.initialMarking().tokens(other.place("x")));
    }

    @Test
    void sameStructure_seesEveryDifferenceButOrderAndName() {
        var net = workshop();
        var reordered = PetriNet.builder("elsewhere")
                .place("carts")
                .place("wheels", 2)
                .place("parts", 5)
                .transition("sell", List.of("carts"), List.of())
                .transition("make", List.of("wheels"), List.of("carts"))
                .arc("parts", "make", 2);

        assertThat(reordered.build().sameStructureAs(net)).isTrue();
        assertThat(reordered.priority("sell", 1).build().sameStructureAs(net)).isFalse();
        assertThat(net.toBuilder().arc("make", "wheels").build().sameStructureAs(net))
                .isFalse();
        assertThat(net.toBuilder().place("nails").build().sameStructureAs(net)).isFalse();
        assertThat(net.renamed("x", name -> name + "1").sameStructureAs(net)).isFalse();
    }

    @Test
    void marking_covers_comparesEveryPlace() {
        var net = workshop();

        assertThat(net.marking("parts", "parts", "carts").covers(net.marking("parts", "carts")))
                .isTrue();
        assertThat(net.marking("parts", "parts").covers(net.marking("carts"))).isFalse();
        assertThat(net.marking("parts", "carts").marked())
                .extracting(Place::name)
                .containsExactly("parts", "carts");
    }
}
