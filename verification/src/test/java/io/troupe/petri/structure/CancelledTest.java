package io.troupe.petri.structure;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.BooleanSupplier;
import org.junit.jupiter.api.Test;

/** Cancelled searches for siphons, traps and invariants. */
class CancelledTest {
    private static BooleanSupplier after(int questions) {
        var asked = new AtomicInteger();
        return () -> asked.incrementAndGet() > questions;
    }

    private static PetriNet places(int count) {
        var net = PetriNet.builder("places");
        for (var i = 0; i < count; i++) {
            net.place("p" + i);
        }
        return net.build();
    }

    /** Each place is a siphon; the first step alone tests all 20,000 places 20,000 times. */
    @Test
    void siphons_cancelledWithinOneStep_endThere() {
        var net = places(20_000);

        assertThat(Siphons.minimalSiphons(net, Siphons.DEFAULT_MAX_STEPS, after(50)))
                .isEqualTo(new MinimalSets(List.of(), false));
        assertThat(Siphons.minimalTraps(net, Siphons.DEFAULT_MAX_STEPS, after(50)))
                .isEqualTo(new MinimalSets(List.of(), false));
    }

    @Test
    void siphons_cancelledOnTheWay_areMinimalOnes() {
        var net = PaperNets.uncorrected(Reading.A);

        var all = Siphons.minimalSiphons(net);
        var some = Siphons.minimalSiphons(net, Siphons.DEFAULT_MAX_STEPS, after(2_000));

        assertThat(some.isComplete()).isFalse();
        assertThat(some.sets()).isNotEmpty().hasSizeLessThan(44);
        assertThat(all.sets()).containsAll(some.sets());
    }

    @Test
    void siphons_cancelledBeforeTheyBegin_areNone() {
        var net = PaperNets.uncorrected(Reading.A);

        assertThat(Siphons.minimalSiphons(net, 1, () -> true)).isEqualTo(new MinimalSets(List.of(), false));
    }

    @Test
    void analysis_withoutTime_decidesNothing() {
        var net = PaperNets.corrected(Reading.A);
        var asked = new AtomicInteger();
        var found = SiphonAnalysis.of(
                net, Siphons.DEFAULT_MAX_STEPS, () -> Duration.ofHours(asked.incrementAndGet() > 2_000 ? 0 : 1));

        assertThat(found.siphons().isComplete()).isFalse();
        assertThat(found.verdicts())
                .hasSameSizeAs(found.siphons().sets())
                .allMatch(SiphonVerdict.MayBeEmptied.class::isInstance);
        assertThat(found.deadlock()).isNotInstanceOf(DeadlockVerdict.NoDeadMarking.class);
        assertThat(SiphonAnalysis.of(net, 1, () -> Duration.ZERO).deadlock())
                .isInstanceOf(DeadlockVerdict.Undecided.class);
        assertThat(SiphonAnalysis.of(net, Siphons.DEFAULT_MAX_STEPS, () -> Duration.ofHours(1))
                        .deadlock())
                .isInstanceOf(DeadlockVerdict.NoDeadMarking.class);
    }

    @Test
    void invariants_cancelled_areIncomplete() {
        var net = PaperNets.uncorrected(Reading.A);
        for (var questions : List.of(0, 20, 60, 200)) {
            var places = Invariants.ofPlaces(net, Invariants.DEFAULT_MAX_ROWS, after(questions));
            var transitions = Invariants.ofTransitions(net, Invariants.DEFAULT_MAX_ROWS, after(questions));

            assertThat(places.isComplete()).isFalse();
            assertThat(Invariants.ofPlaces(net).invariants()).containsAll(places.invariants());
            assertThat(transitions.isComplete()).isFalse();
            assertThat(Invariants.ofTransitions(net).invariants()).containsAll(transitions.invariants());
        }
        assertThat(Invariants.ofPlaces(places(3), 10, () -> true).isComplete()).isFalse();
    }
}
