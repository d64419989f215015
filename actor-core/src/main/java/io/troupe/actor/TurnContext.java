package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * Carries what belongs to a caller, for example a logging context or a trace, into the turns that its calls and
 * listeners cause; see {@link SpaceSettings#withContext}.
 *
 * {@snippet :
 * TurnContext<String> user = new TurnContext<>() {
 *     @Override
 *     public String capture() {
 *         return USER.get();
 *     }
 *
 *     @Override
 *     public Runnable restore(String captured) {
 *         USER.set(captured);
 *         return USER::remove;
 *     }
 * };
 * }
 *
 * <p><b>Errors.</b> What these methods throw is reported; the turn runs all the same, without the context.
 *
 * @param <C> the context
 */
public interface TurnContext<C> {
    /** Returns the context of the calling thread, or null if it has none. Called for each call and each listener. */
    @Nullable
    C capture();

    /**
     * Makes a context that of the calling thread, which is the space's, for one turn.
     *
     * @return run at the end of the turn
     */
    Runnable restore(C captured);
}
