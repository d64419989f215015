package io.troupe.actor.model;

import io.troupe.actor.model.Act.Kind;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;

/** The kinds of acts of one program: some are frequent and some do not occur, so that rare ones meet. */
final class Deck {
    private final Random random;
    private final List<Kind> kinds = new ArrayList<>();

    Deck(Random random, Ending ending) {
        this.random = random;
        for (Kind kind : Kind.values()) {
            if (kind != Kind.READER && !ending.leavesOut(kind)) {
                int often = Math.max(0, random.nextInt(7) - 2);
                if (kind == Kind.ADVANCE || kind == Kind.THROW) {
                    often = 2 + random.nextInt(3);
                } else if (kind == Kind.TELL || kind == Kind.ASK) {
                    often = 6;
                } else if (kind == Kind.CLOSE) {
                    often /= 4; // nothing follows it
                } else if (kind == Kind.STOP || kind == Kind.STOP_SELF) {
                    often /= 3; // little happens to a stopped actor
                }
                for (int i = 0; i < often; i++) {
                    kinds.add(kind);
                }
            }
        }
    }

    Kind draw() {
        return kinds.get(random.nextInt(kinds.size()));
    }
}
