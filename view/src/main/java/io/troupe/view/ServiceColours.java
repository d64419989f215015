package io.troupe.view;

import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** The colours of services, alike in all pictures. */
public final class ServiceColours {
    private static final String UNKNOWN = "#888888";

    private static final Map<String, String> KNOWN = Map.of(
            Service.WALL_FOLLOWER.name(), "#7b3fa0",
            Service.SPACE_WANDERER.name(), "#1b9e9e");
    /** Colours of further services, used cyclically. */
    private static final List<String> MORE = List.of("#d95f02", "#4c78a8", "#9c755f", "#66a61e", "#b07aa1", "#888888");

    private final Map<String, String> colours = new HashMap<>(KNOWN);

    private ServiceColours(List<String> services) {
        for (String service : services) {
            int more = colours.size() - KNOWN.size();
            colours.putIfAbsent(service, MORE.get(more % MORE.size()));
        }
    }

    /** The colours of a table's services. */
    public static ServiceColours of(SubsumptionTable table) {
        return of(table.services().stream().map(Service::name).toList());
    }

    /** The colours of services with these names. */
    public static ServiceColours of(List<String> services) {
        return new ServiceColours(services);
    }

    /** A colour as in SVG and CSS; grey for any other name. */
    public String colour(String service) {
        return colours.getOrDefault(service, UNKNOWN);
    }
}
