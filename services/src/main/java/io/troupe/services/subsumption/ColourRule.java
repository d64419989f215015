package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Blob;
import java.util.List;
import java.util.OptionalInt;

/** Which of the colours that a robot sees is to end its state. A pure function. */
@FunctionalInterface
public interface ColourRule {
    /** None: for services without a colour finder. */
    ColourRule NONE = (blobs, secondsInCharge) -> OptionalInt.empty();

    /**
     * Picks a colour.
     *
     * @param secondsInCharge since the robot's service took charge, on the robot's clock
     */
    OptionalInt pick(List<Blob> blobs, double secondsInCharge);
}
