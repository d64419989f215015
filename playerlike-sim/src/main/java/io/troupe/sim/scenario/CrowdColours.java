package io.troupe.sim.scenario;

import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/**
 * Chooses named colours for the panels of a crowd's halls. Each is as far as possible from all earlier ones and from
 * those of walls and robots.
 */
final class CrowdColours {
    private static final List<String> TAKEN = List.of("black", "orange", "white");
    private static final List<String> FIRST = List.of("blue", "red", "green");

    private CrowdColours() {}

    /** The given number of names, starting with the three colours of the paper. */
    static List<String> names(int count) {
        Map<String, Integer> candidates = new TreeMap<>(X11Colours.byName());
        var chosen = new ArrayList<String>(FIRST.subList(0, Math.min(count, FIRST.size())));
        var values = new ArrayList<Integer>();
        TAKEN.forEach(name -> values.add(candidates.get(name)));
        FIRST.forEach(name -> values.add(candidates.get(name)));
        while (chosen.size() < count) {
            String farthest = farthest(candidates, values);
            chosen.add(farthest);
            values.add(candidates.get(farthest));
        }
        return chosen;
    }

    private static String farthest(Map<String, Integer> candidates, Collection<Integer> from) {
        String best = "";
        int bestSquare = -1;
        for (var candidate : candidates.entrySet()) {
            int square = from.stream()
                    .mapToInt(other -> square(candidate.getValue(), other))
                    .min()
                    .orElse(Integer.MAX_VALUE);
            if (square > bestSquare) {
                best = candidate.getKey();
                bestSquare = square;
            }
        }
        return best;
    }

    private static int square(int colour, int other) {
        int sum = 0;
        for (int shift = 0; shift <= 16; shift += 8) {
            int difference = (colour >> shift & 0xff) - (other >> shift & 0xff);
            sum += difference * difference;
        }
        return sum;
    }
}
