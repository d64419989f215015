package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import com.sun.management.ThreadMXBean;
import java.lang.management.ManagementFactory;
import java.util.List;
import org.junit.jupiter.api.Test;

/** The memory that searches use, and how they end when there is no more. */
class MemoryTest {
    private static final long MIB = 1 << 20;

    /** n switches that are switched once, in any order: 2^n markings, n 2^(n-1) edges, one dead marking. */
    private static PetriNet switches(int count) {
        var net = PetriNet.builder("switches");
        for (var i = 0; i < count; i++) {
            net.place("off" + i, 1).place("on" + i).transition("t" + i, List.of("off" + i), List.of("on" + i));
        }
        return net.build();
    }

    /** Each of n steps goes left or right, irrevocably: 2^n dead markings, n firings away. */
    private static PetriNet choices(int count) {
        var net = PetriNet.builder("choices").place("p0", 1);
        for (var i = 0; i < count; i++) {
            net.place("l" + i).place("r" + i).place("p" + (i + 1));
            net.transition("left" + i, List.of("p" + i), List.of("l" + i, "p" + (i + 1)));
            net.transition("right" + i, List.of("p" + i), List.of("r" + i, "p" + (i + 1)));
        }
        return net.build();
    }

    private static PetriNet unbounded() {
        return PetriNet.builder("unbounded")
                .place("a", 1)
                .place("many")
                .transition("t", List.of("a"), List.of("a", "many"))
                .build();
    }

    private static long allocated(Runnable work) {
        var threads = (ThreadMXBean) ManagementFactory.getThreadMXBean();
        var before = threads.getCurrentThreadAllocatedBytes();
        work.run();
        return threads.getCurrentThreadAllocatedBytes() - before;
    }

    /** With two priorities stubborn sets follow all transitions, so that both searches visit the same markings. */
    @Test
    void deadlockSearch_keepsNoEdges() {
        var net = switches(14).toBuilder()
                .transition("never", List.of(), List.of())
                .remove("never")
                .place("key")
                .transition("last", List.of("key"), List.of())
                .priority("last", 1)
                .build();
        var limits = SearchLimits.markings(1 << 20).within(2 * MIB);

        var search = DeadlockSearch.run(net, limits);
        var graph = ReachabilityGraph.explore(net, limits);

        assertThat(search.end()).isEqualTo(SearchEnd.COMPLETE);
        assertThat(search.visitedMarkings()).isEqualTo(1 << 14);
        assertThat(search.visitedEdges()).isEqualTo(14 << 13);
        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isLessThan(1 << 14);
    }

    @Test
    void search_atItsLimitOfMemory_tellsWhatItKnows() {
        var graph = ReachabilityGraph.explore(
                unbounded(), SearchLimits.markings(Integer.MAX_VALUE).within(4 * MIB));

        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isGreaterThan(1000);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.UNKNOWN);
        assertThat(graph.openCount()).isPositive();
        assertThat(graph.states().get(graph.size() - 1).isOpen()).isTrue();
        assertThat(graph.summary()).startsWith("unbounded: out of memory at " + graph.size() + " markings; ");
        assertThat(Liveness.of(graph).live()).isEqualTo(Verdict.UNKNOWN);
        assertThat(DeadlockSearch.run(
                        unbounded(), SearchLimits.markings(Integer.MAX_VALUE).within(4 * MIB)))
                .asString()
                .endsWith("0 dead so far; out of memory");
    }

    /** Simulates a virtual machine without memory; the markings found so far are kept. */
    @Test
    void outOfMemoryError_endsTheSearchWithWhatItHas() {
        var net = switches(10);
        var rules = new FiringRules(net);
        Expansion failing = new Expansion() {
            private int asked;

            @Override
            public int choose(int[] tokens, int[] chosen) {
                if (++asked == 100) {
                    throw new OutOfMemoryError("Java heap space");
                }
                return rules.choose(tokens, chosen);
            }
        };

        var graph = ReachabilityGraph.explore(net, failing, SearchLimits.markings(10_000));

        assertThat(graph.end()).isEqualTo(SearchEnd.MEMORY);
        assertThat(graph.size()).isGreaterThan(100);
        assertThat(graph.openCount()).isEqualTo(graph.size() - 99);
        assertThat(graph.states().get(98).successors()).isNotEmpty();
        assertThat(graph.states().get(99).successors()).isEmpty();
        assertThat(Liveness.of(graph).reversible()).isEqualTo(Verdict.UNKNOWN);
    }

    @Test
    void deadlocks_areMadeWhenTheyAreAskedFor() {
        var search = DeadlockSearch.run(choices(12));

        var dead = search.deadlocks();

        assertThat(dead).hasSize(1 << 12);
        // 4,096 traces of 12 firings would take more than 300 kB
        assertThat(allocated(() -> assertThat(search.deadlocks().size()).isPositive()))
                .isLessThan(20_000);
        assertThat(dead.get(4095).trace()).hasSize(12);
    }

    /** A row of places. Comparing all pairs of 2,000 transitions would need 4,000,000 pairs and hundreds of MiB. */
    @Test
    void stubbornSets_ofALargeNet_areMadeFromItsArcs() {
        var net = PetriNet.builder("row").place("p0", 1);
        for (var i = 1; i <= 2000; i++) {
            net.place("p" + i).transition("t" + i, List.of("p" + (i - 1)), List.of("p" + i));
        }
        var built = net.build();

        assertThat(allocated(() -> new StubbornSets(built))).isLessThan(20 * MIB);
        assertThat(DeadlockSearch.run(built).visitedMarkings()).isEqualTo(2001);
    }

    @Test
    void summaries_ofManyComponentsAndNames_areShort() {
        var net = choices(10).toBuilder();
        for (var i = 0; i < 1000; i++) {
            net.place("empty" + i);
        }
        var graph = ReachabilityGraph.explore(net.build());

        var liveness = Liveness.of(graph);

        assertThat(liveness.terminalComponents()).hasSize(1024);
        assertThat(liveness.summary().lines()).hasSizeLessThan(20);
        assertThat(liveness.summary()).endsWith("\n    and 1008 more");
        assertThat(graph.summary()).contains("empty198, empty199, .. and 800 more]");
    }

    @Test
    void limitOfMemory_belowOne_isRefused() {
        assertThatIllegalArgumentException()
                .isThrownBy(() -> SearchLimits.markings(1).within(0))
                .withMessage("maxBytes is 0, expected 1 or more");
    }
}
