package io.troupe.petri.wiring;

/** Names for the places and transitions of a wiring's net, in the words of the declaration. */
record Labels(Wiring wiring) {
    String label(String component, Protocol protocol, Step step) {
        return switch (step) {
            case Step.Does does ->
                component + ": " + does.label() + (isUnique(protocol, does) ? "" : " (in " + step.from() + ")");
            case Step.Requests request -> request(component, request);
            case Step.Provides offer -> component + " does " + offer.call();
            case Step.Stops stop ->
                component + " stops" + (protocol.stopStates().size() == 1 ? "" : " in " + stop.from());
        };
    }

    private static boolean isUnique(Protocol protocol, Step.Does does) {
        return protocol.steps().stream()
                        .filter(step ->
                                step instanceof Step.Does other && other.label().equals(does.label()))
                        .count()
                == 1;
    }

    String request(String component, Step.Requests request) {
        return component + " requests " + wiring.provider(component, request) + "." + request.call()
                + where(component, request);
    }

    /** The state of a call; empty unless the same call is made in several states. */
    String where(String component, Step.Requests request) {
        var provider = wiring.provider(component, request);
        var same = wiring.protocol(component).requests().stream()
                .filter(other -> other.call().equals(request.call())
                        && wiring.provider(component, other).equals(provider))
                .count();
        return same == 1 ? "" : " (in " + request.from() + ")";
    }

    static String place(String component, String state) {
        return component + "." + state;
    }
}
