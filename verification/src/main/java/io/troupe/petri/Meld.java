package io.troupe.petri;

import static java.util.Objects.requireNonNull;

/**
 * A request of one component bound to what another one offers, with the names of the places and transitions this adds.
 *
 * <p>{@code request} takes from its places and puts to others; {@code offer} likewise in its own component. Melded, the
 * requestor first asks ({@code asking}: its input places to {@code waiting}), then both sides step together
 * ({@code accept}: {@code waiting} and the offer's input places to {@code pending} and {@code before}), the offer fires
 * in private ({@code before} to {@code after}), and both step together again ({@code answer}: {@code pending} and
 * {@code after} to the output places of both).
 *
 * <p><b>Source.</b> Section 5.5 of the paper; close to the composition of components by Craig and Zuberek (2007).
 *
 * @param request the transition that is taken out
 * @param offer the transition that becomes private
 * @param asking the transition that replaces {@code request}
 * @param waiting the place of a requestor that nobody has heard yet
 * @param accept the first common transition
 * @param pending the place of a requestor that is being served
 * @param before the place of a provider that was asked
 * @param after the place of a provider that is done
 * @param answer the second common transition
 */
public record Meld(
        String request,
        String offer,
        String asking,
        String waiting,
        String accept,
        String pending,
        String before,
        String after,
        String answer) {
    public Meld {
        requireNonNull(request, "request");
        requireNonNull(offer, "offer");
        requireNonNull(asking, "asking");
        requireNonNull(waiting, "waiting");
        requireNonNull(accept, "accept");
        requireNonNull(pending, "pending");
        requireNonNull(before, "before");
        requireNonNull(after, "after");
        requireNonNull(answer, "answer");
        if (request.equals(offer)) {
            throw new IllegalArgumentException("transition " + request + " cannot be melded with itself");
        }
    }

    /** A meld with names made from those of its two transitions. */
    public static Meld of(String request, String offer) {
        var call = request + "/" + offer;
        return new Meld(
                request,
                offer,
                request + "''",
                request + ".waiting",
                call + ".accept",
                request + ".pending",
                offer + ".before",
                offer + ".after",
                call + ".answer");
    }
}
