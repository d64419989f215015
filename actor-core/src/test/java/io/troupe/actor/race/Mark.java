package io.troupe.actor.race;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.regex.Pattern;

/** The argument of one call, with the number of times the call was handled and became a dead letter. */
final class Mark {
    final AtomicInteger served = new AtomicInteger();
    final AtomicInteger dead = new AtomicInteger();
    private final int number;

    private Mark(int number) {
        this.number = number;
    }

    @Override
    public String toString() {
        return "#" + number + "#";
    }

    /** Creates marks, and finds them again in the texts of dead letters; any thread. */
    static final class All {
        private static final Pattern TEXT = Pattern.compile("#(\\d+)#");

        private final Map<Integer, Mark> marks = new ConcurrentHashMap<>();
        private final AtomicInteger made = new AtomicInteger();

        Mark next() {
            var mark = new Mark(made.incrementAndGet());
            marks.put(mark.number, mark);
            return mark;
        }

        void deadLetter(String message) {
            var found = TEXT.matcher(message);
            if (found.find()) {
                marks.get(Integer.valueOf(found.group(1))).dead.incrementAndGet();
            }
        }
    }
}
