package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Blob;
import java.util.List;
import java.util.OptionalInt;

/** Selects which of the colours that a robot sees ends its state. A pure function. */
@FunctionalInterface
public interface ColourRule {
    /** Selects no colour; for services without a colour finder. */
    ColourRule NONE = (blobs, secondsInCharge) -> OptionalInt.empty();

    /**
     * Returns the selected colour, or empty.
     *
     * @param secondsInCharge time since the robot's service started to drive it, on the robot's clock
     */
    OptionalInt pick(List<Blob> blobs, double secondsInCharge);
}
