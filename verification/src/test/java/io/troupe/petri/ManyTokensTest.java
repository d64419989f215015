package io.troupe.petri;

import static io.troupe.petri.Nets.net;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Unknown;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.DeadlockSearch.Deadlock;
import io.troupe.petri.deadlock.DeadlockCheck;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Places that hold more tokens than an int. */
class ManyTokensTest {
    private static final SearchLimits LIMITS = SearchLimits.markings(3000);

    private static Deadlock dead(Answer<Deadlock> answer) {
        return ((No<Deadlock>) answer).counterexample();
    }

    private static void assertDead(PetriNet net, String trace, String marking) {
        var found = dead(DeadlockCheck.decide(net, LIMITS));
        assertThat(found.trace()).hasToString(trace);
        assertThat(found.marking()).hasToString(marking);
    }

    @Test
    void firings_countThem_upToALong() {
        var net = net("n", "lake=4000000000 n=3", "drain: n 2000000000*lake >", "fill: n > 1000000000*lake");
        var drain = net.transition("drain");
        var fill = net.transition("fill");
        assertThat(net.fire(net.initialMarking(), List.of(drain, fill, drain))).hasToString("{1000000000*lake}");
        assertThat(net.fire(net.initialMarking(), List.of(fill, fill, fill))).hasToString("{7000000000*lake}");
        assertThatThrownBy(() -> net.fire(net.initialMarking(), List.of(drain, drain, drain)))
                .hasMessage("transition drain may not fire in {n}: lake holds 0 of 2000000000");
        var full = net("n", "lake=" + Long.MAX_VALUE, "fill: > 2*lake");
        assertThatThrownBy(() -> full.fire(full.initialMarking(), full.transition("fill")))
                .hasMessage("place lake would hold more than 9223372036854775807 tokens");
    }

    /** The fields of the stored markings grow with the tokens, up to 64 bits. */
    @Test
    void graph_hasThem() {
        var net = net("n", "lake=1 n=62", "double: n lake > lake", "up: lake > 2000000000*lake");
        var graph = ReachabilityGraph.explore(net, SearchLimits.markings(500));
        assertThat(graph.mostTokens(net.place("lake"))).isGreaterThan(4_000_000_000L);
        assertThat(graph.states())
                .allSatisfy(state -> assertThat(net.fire(net.initialMarking(), state.shortestTrace()))
                        .isEqualTo(state.marking()));
        var wide = net("n", "sea=9000000000000000000 pond", "move: 2000000000*sea > pond");
        assertThat(ReachabilityGraph.explore(wide, SearchLimits.markings(50)).states())
                .last()
                .hasToString("{8999999902000000000*sea, 49*pond}");
    }

    @Test
    void deadlocks_areFound_withAllTokens() {
        var working = net(
                "n",
                "lake=4000000000 idle=1 stuck",
                "work: idle lake > idle",
                "stop: idle > stuck",
                "back: stuck > idle");
        assertDead(working.toBuilder().inhibitor("lake", "back").build(), "[stop]", "{4000000000*lake, stuck}");
        assertDead(
                net("n", "lake=4000000000 job=3 done", "work: job 2*lake > done"),
                "[work, work, work]",
                "{3999999994*lake, 3*done}");
        assertDead(
                net("n", "job=3 lake=4000000000", "fill: job > 1000000000*lake"),
                "[fill, fill, fill]",
                "{7000000000*lake}");
        // two firings of three are possible with these tokens
        assertDead(net("n", "lake=4000000000 job=3", "work: job 2000000000*lake >"), "[work, work]", "{job}");
    }

    /** After four thousand million firings the net is dead, but no search gets there. */
    @Test
    void deadlock_afterAsManyFirings_isNotKnown() {
        assertThat(DeadlockCheck.decide(net("n", "lake=4000000000 glass", "drink: lake >"), LIMITS))
                .isInstanceOf(Unknown.class);
    }

    /** No reachable marking is dead, whatever the tokens. */
    @Test
    void proof_holdsWithThem() {
        var net = net("n", "lake=4000000000 idle=1 busy", "work: idle lake > busy", "back: busy > idle lake");
        assertThat(DeadlockCheck.decide(net, LIMITS)).isInstanceOf(Yes.class);
    }
}
