package io.troupe.petri;

import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * Composes components, which are nets, into one net.
 *
 * <p><b>Errors.</b> An unknown or repeated name throws {@link IllegalArgumentException}.
 */
public final class Composition {
    private Composition() {}

    /**
     * Puts {@code components} side by side and applies {@code melds} to the result; see {@link #meld}. The names of the
     * components must differ.
     */
    public static PetriNet compose(String name, List<PetriNet> components, List<Meld> melds) {
        var union = PetriNet.builder(name);
        components.forEach(union::add);
        return meld(union.build(), melds);
    }

    /**
     * Binds requests to offers inside one net, one after the other.
     *
     * <p>Several requests may be bound to one offer in the same call: they share its {@code before} and {@code after},
     * and so must give these the same names. This is right as long as the provider serves one request at a time. A new
     * transition takes the priority of the side that decides about it: {@code asking} that of the request,
     * {@code accept} and {@code answer} that of the offer. The inhibitor arcs of the request stay with {@code asking},
     * those of the offer with {@code accept}.
     */
    public static PetriNet meld(PetriNet net, List<Meld> melds) {
        var result = net.toBuilder();
        var bound = new HashSet<String>();
        var first = new HashMap<String, Meld>();
        var offers = new HashMap<String, PetriNetBuilder.Draft>();
        for (var meld : melds) {
            if (!bound.add(meld.request())) {
                throw new IllegalArgumentException(
                        "net " + net.name() + ": request " + meld.request() + " is melded twice");
            }
            var request = result.take(meld.request());
            result.place(meld.waiting()).place(meld.pending());
            var shared = first.putIfAbsent(meld.offer(), meld);
            if (shared == null) {
                var offer = result.take(meld.offer());
                offers.put(meld.offer(), offer);
                result.place(meld.before()).place(meld.after());
                result.transition(
                        meld.offer(),
                        draft(offer.priority(), Map.of(meld.before(), 1), Map.of(meld.after(), 1), Map.of()));
            } else if (!shared.before().equals(meld.before()) || !shared.after().equals(meld.after())) {
                throw new IllegalArgumentException("net " + net.name() + ": requests " + shared.request() + " and "
                        + meld.request() + " share offer " + meld.offer()
                        + " and must name the same places before and after it");
            }
            var offer = offers.get(meld.offer());
            var priority = offer.priority();
            result.transition(
                    meld.asking(),
                    draft(request.priority(), request.in(), Map.of(meld.waiting(), 1), request.inhibitors()));
            result.transition(
                    meld.accept(),
                    draft(
                            priority,
                            sum(Map.of(meld.waiting(), 1), offer.in()),
                            sum(Map.of(meld.pending(), 1), Map.of(meld.before(), 1)),
                            offer.inhibitors()));
            result.transition(
                    meld.answer(),
                    draft(
                            priority,
                            sum(Map.of(meld.pending(), 1), Map.of(meld.after(), 1)),
                            sum(request.out(), offer.out()),
                            Map.of()));
        }
        return result.build();
    }

    /**
     * Replaces several transitions by one that does the steps of all of them at once, at the lowest of their
     * priorities.
     *
     * <p>Fusing the private stops of all components makes the synchronised stop of the paper's corrected net.
     */
    public static PetriNet fuse(PetriNet net, String fused, List<String> transitions) {
        if (transitions.isEmpty()) {
            throw new IllegalArgumentException(
                    "net " + net.name() + ": there are no transitions to fuse into " + fused);
        }
        var result = net.toBuilder();
        var priority = Integer.MAX_VALUE;
        Map<String, Integer> in = new LinkedHashMap<>();
        Map<String, Integer> out = new LinkedHashMap<>();
        Map<String, Integer> inhibitors = new LinkedHashMap<>();
        for (var transition : transitions) {
            var part = result.take(transition);
            priority = Math.min(priority, part.priority());
            in = sum(in, part.in());
            out = sum(out, part.out());
            part.inhibitors().forEach((place, weight) -> inhibitors.merge(place, weight, Math::min));
        }
        return result.transition(fused, draft(priority, in, out, inhibitors)).build();
    }

    private static PetriNetBuilder.Draft draft(
            int priority, Map<String, Integer> in, Map<String, Integer> out, Map<String, Integer> inhibitors) {
        return new PetriNetBuilder.Draft(
                priority, new LinkedHashMap<>(in), new LinkedHashMap<>(out), new LinkedHashMap<>(inhibitors));
    }

    private static Map<String, Integer> sum(Map<String, Integer> one, Map<String, Integer> other) {
        var sum = new LinkedHashMap<>(one);
        other.forEach((place, weight) -> sum.merge(place, weight, Math::addExact));
        return sum;
    }
}
