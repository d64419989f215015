package io.troupe.services.subsumption;

import java.util.Locale;

/** The paper's three ways to run the same services. */
public enum Mode {
    /** One thread, one connection, the services' cycles one after the other (section 3.4, Figure 14). */
    SYNC,
    /**
     * Actors; every colour is sent to the arbitrator, and the arbitrator stops the services (section 3.5, Figure 17).
     */
    CALLBACK,
    /** Actors; a service that sees a colour ends itself and sends that one colour (section 3.6, Figure 20). */
    PROMISE;

    @Override
    public String toString() {
        return name().toLowerCase(Locale.ROOT);
    }
}
