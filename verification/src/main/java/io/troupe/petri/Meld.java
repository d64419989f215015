package io.troupe.petri;

import static java.util.Objects.requireNonNull;

/**
 * Binds a request of one component to an offer of another, and names the places and transitions that this adds. "Meld"
 * is the paper's word for it.
 *
 * <p>{@code request} takes tokens from places of one component and puts tokens on others; {@code offer} does the same
 * in another component. Melding replaces them by four steps. First the requestor asks ({@code asking}: the request's
 * input places to {@code waiting}). Then both sides step together ({@code accept}: {@code waiting} and the offer's
 * input places to {@code pending} and {@code before}). The offer fires alone ({@code before} to {@code after}). Both
 * step together again ({@code answer}: {@code pending} and {@code after} to the output places of both).
 *
 * <p><b>Source.</b> Section 5.5 of the paper; close to the composition of components by Craig and Zuberek (2007).
 *
 * @param request the transition that is removed
 * @param offer the transition that becomes private
 * @param asking the transition that replaces {@code request}
 * @param waiting the place of a requestor whose request is not accepted yet
 * @param accept the first common transition
 * @param pending the place of a requestor whose request is being served
 * @param before the place of a provider that has accepted a request
 * @param after the place of a provider that has served a request
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

    /** Creates a meld whose names are derived from those of its two transitions. */
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
