package io.troupe.services.behaviour;

import java.util.Comparator;
import java.util.List;
import java.util.OptionalInt;
import java.util.function.IntPredicate;
import java.util.function.IntUnaryOperator;
import java.util.stream.IntStream;

/**
 * Selects colours from the blobs that a robot's camera sees.
 *
 * <p><b>Role.</b> Pure functions of the blobfinder's data.
 *
 * <p><b>Source.</b> Paper, section 3.2 (colour finder). The paper does not define which of several blobs counts; our
 * rule is the largest, and of equally large ones the leftmost.
 */
public final class ColourFinder {
    /** Smaller blobs are treated as noise. */
    public static final int MIN_AREA_PX2 = 10;

    private ColourFinder() {}

    /** Returns the colour of the largest blob whose colour matches the predicate. */
    public static OptionalInt find(List<Blob> blobs, IntPredicate ofInterest) {
        return inOrder(blobs, colour -> 0).filter(ofInterest).findFirst();
    }

    /**
     * Returns the colours of all blobs that are large enough: in descending order of priority, then of area, then from
     * left to right. A colour appears once for each of its blobs.
     *
     * @param priority maps a colour to its priority
     */
    public static IntStream inOrder(List<Blob> blobs, IntUnaryOperator priority) {
        if (blobs.isEmpty()) {
            return IntStream.empty(); // the usual case, so it does not sort
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
