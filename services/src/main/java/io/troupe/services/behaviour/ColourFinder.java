package io.troupe.services.behaviour;

import java.util.Comparator;
import java.util.List;
import java.util.OptionalInt;
import java.util.function.IntPredicate;
import java.util.function.IntUnaryOperator;
import java.util.stream.IntStream;

/**
 * Picks the colour that a robot looks at.
 *
 * <p><b>Role.</b> A pure function of what the blobfinder sees.
 *
 * <p><b>Source.</b> Paper, section 3.2 (colour finder); which of several blobs counts is our rule: the largest, and of
 * equal ones the leftmost.
 */
public final class ColourFinder {
    /** Anything smaller is taken for noise. */
    public static final int MIN_AREA_PX2 = 10;

    private ColourFinder() {}

    /** The colour of the largest patch among those that are of interest. */
    public static OptionalInt find(List<Blob> blobs, IntPredicate ofInterest) {
        return inOrder(blobs, colour -> 0).filter(ofInterest).findFirst();
    }

    /**
     * The colours of all patches that are large enough, those of higher priority first; of equal ones the largest, of
     * equally large ones the leftmost.
     *
     * @param priority of a colour
     */
    public static IntStream inOrder(List<Blob> blobs, IntUnaryOperator priority) {
        if (blobs.isEmpty()) {
            return IntStream.empty(); // mostly, and for many robots many times a second
        }
        return blobs.stream()
                .filter(blob -> blob.areaPx2() >= MIN_AREA_PX2)
                .sorted(Comparator.<Blob>comparingInt(blob -> priority.applyAsInt(blob.colour()))
                        .thenComparingInt(Blob::areaPx2)
                        .reversed()
                        .thenComparingInt(Blob::leftPx))
                .mapToInt(Blob::colour);
    }
}
