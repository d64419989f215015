package io.troupe.petri;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.stream.IntStream;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class MarkingStoreTest {
    private static final int PLACES = 8; // the last word is full
    private static final int MARKINGS = 1 << 10;

    /** Of as many random slots as there are markings, 1 - 1/e differ: 647. */
    @ParameterizedTest
    @ValueSource(ints = {16, 32, 64})
    void markings_thatDifferOnOnePlace_haveDifferentSlots(int bits) {
        var store = new MarkingStore(PLACES, bits);
        for (var place = 0; place < PLACES; place++) {
            var tokens = new long[PLACES];
            var marked = place;
            var slots = IntStream.range(0, MARKINGS).map(count -> {
                tokens[marked] = count;
                return MarkingStore.hash(store.pack(tokens)) & MARKINGS - 1;
            });
            assertThat(slots.distinct().count()).as("place %d", place).isGreaterThan(MARKINGS / 2);
        }
    }
}
