package io.troupe.services.behaviour;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;

class ColourFinderTest {
    private static final int RED = 0xFF0000;
    private static final int GREEN = 0x00FF00;

    @Test
    void largestSightingOfInterest_counts() {
        var seen = List.of(TestBlobs.of(RED, 50, 0), TestBlobs.of(GREEN, 60, 40), TestBlobs.of(0, 900, 60));
        assertThat(ColourFinder.find(seen, colour -> colour != 0)).hasValue(GREEN);
    }

    @Test
    void equalAreas_theLeftmostCounts() {
        var seen = List.of(TestBlobs.of(RED, 50, 30), TestBlobs.of(GREEN, 50, 10));
        assertThat(ColourFinder.find(seen, colour -> true)).hasValue(GREEN);
    }

    @Test
    void sightingBelowTenPixels_isNoise() {
        assertThat(ColourFinder.find(List.of(TestBlobs.of(RED, 9, 0)), colour -> true))
                .isEmpty();
        assertThat(ColourFinder.find(List.of(TestBlobs.of(RED, 10, 0)), colour -> true))
                .hasValue(RED);
    }

    @Test
    void nothingOfInterest_isNothing() {
        assertThat(ColourFinder.find(List.of(TestBlobs.of(RED, 90, 0)), colour -> colour == GREEN))
                .isEmpty();
    }

    @Test
    void priorities_countBeforeAreas_theSmallestOfAllNumbersTooComesLast() {
        var seen = List.of(TestBlobs.of(RED, 90, 0), TestBlobs.of(GREEN, 50, 10), TestBlobs.of(0, 60, 20));
        Map<Integer, Integer> priorities = Map.of(RED, Integer.MIN_VALUE, GREEN, 0, 0, Integer.MAX_VALUE);
        assertThat(ColourFinder.inOrder(seen, priorities::get)).containsExactly(0, GREEN, RED);
    }
}
