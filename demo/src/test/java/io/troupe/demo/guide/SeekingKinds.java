package io.troupe.demo.guide;

import io.troupe.common.text.NamedColours;
import io.troupe.services.subsumption.ServiceArguments;
import io.troupe.services.subsumption.ServiceCatalogue.Kind;
import io.troupe.services.subsumption.ServiceKinds;
import java.util.List;

/** The kinds {@code seek} and {@code follow}. */
public final class SeekingKinds implements ServiceKinds {
    @Override
    public List<Kind> kinds() {
        return List.of(
                new Kind("seek", true, true, arguments -> {
                    int colour = colour(arguments);
                    double nearM = arguments.number("near", 0.6);
                    return () -> LightSeeker.towards(colour, nearM);
                }),
                new Kind("follow", true, true, arguments -> {
                    int colour = colour(arguments);
                    double gapM = arguments.number("gap", 0.8);
                    return () -> LeaderFollower.behind(colour, gapM);
                }));
    }

    private static int colour(ServiceArguments arguments) {
        String name = arguments.choice("colour", List.copyOf(NamedColours.names()));
        return NamedColours.named(name).orElseThrow();
    }
}
