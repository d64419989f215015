package io.troupe.services.behaviour;

import java.util.List;
import java.util.OptionalInt;
import java.util.function.IntPredicate;

/**
 * Picks the colour that a robot looks at.
 *
 * <p><b>Role.</b> A pure function of what the blobfinder sees.
 * <p><b>Source.</b> Paper, section 3.2 (colour finder); which of several blobs counts is our rule: the largest, and of equal ones the leftmost.
 */
public final class ColourFinder {
    /** Anything smaller is taken for noise. */
    public static final int MIN_AREA_PX2 = 10;

    /**
     * A patch of colour in the image.
     *
     * @param colour {@code 0x00RRGGBB}
     * @param leftPx its first column
     */
    public record Sighting(int colour, int areaPx2, int leftPx) {}

    private ColourFinder() {}

    /** The colour of the largest patch among those that are of interest. */
    public static OptionalInt find(List<Sighting> sightings, IntPredicate ofInterest) {
        Sighting best = null;
        for (var sighting : sightings) {
            if (sighting.areaPx2 < MIN_AREA_PX2 || !ofInterest.test(sighting.colour)) {
                continue;
            }
            boolean larger = best == null || sighting.areaPx2 > best.areaPx2;
            if (larger || sighting.areaPx2 == best.areaPx2 && sighting.leftPx < best.leftPx) {
                best = sighting;
            }
        }
        return best == null ? OptionalInt.empty() : OptionalInt.of(best.colour);
    }
}
