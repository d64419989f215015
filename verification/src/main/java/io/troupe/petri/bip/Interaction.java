package io.troupe.petri.bip;

import java.util.List;
import java.util.stream.Collectors;

/**
 * A set of ports of one connector that take part together.
 *
 * @param connector the connector that allows it
 * @param ends the ports that take part, in the order of the connector
 */
public record Interaction(Connector connector, List<Connector.End> ends) {
    public Interaction {
        ends = List.copyOf(ends);
    }

    /** Whether all ports of the connector take part. */
    public boolean isWhole() {
        return ends.size() == connector.ends().size();
    }

    /** The connector, and the ports unless all take part. */
    @Override
    public String toString() {
        return isWhole()
                ? connector.name()
                : ends.stream()
                        .map(Connector.End::toString)
                        .collect(Collectors.joining(" ", connector.name() + "[", "]"));
    }
}
