package io.troupe.services.broker;

import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Address;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Keeps the registry of services, finds them, starts them when they are needed, watches their health, and tells those who use them when another takes over.
 *
 * <p><b>Threads.</b> Any thread calls; listeners run on the actor space on which they were registered.
 * <p><b>Errors.</b> A need that nobody can meet is rejected with a {@link MissingServiceException}.
 * <p><b>Source.</b> Paper, section 2.2.4; "in case a service is not present the system should terminate gracefully", section 1.
 */
public interface Broker extends AutoCloseable {
    /**
     * Offers a service.
     *
     * @param capabilities may be empty
     * @throws IllegalArgumentException if something is registered at that address already
     */
    Promise<ServiceRecord> register(String service, List<String> capabilities, Address address, Provider provider);

    /** Withdraws an offer: those who use it get another provider, or hear that there is none; then it is stopped. */
    Promise<@Nullable Void> withdraw(Address provider);

    /** Puts a provider in another's place while the application runs: the new one is started, users are told, the old one is stopped. */
    Promise<ServiceRecord> replace(
            Address old, String service, List<String> capabilities, Address address, Provider provider);

    /** Everything that is registered, in the order of registration. */
    Promise<List<ServiceRecord>> registered();

    /** All who meet a need, the best first: well before suspect, then in the order of registration. Starts nothing. */
    Promise<List<ServiceRecord>> find(Need need);

    /** One provider that runs: started if none does; the next one if one cannot be started. */
    Promise<ServiceRecord> require(Need need);

    /**
     * Stays connected: the listener hears of the provider to use, at first and whenever another takes its place.
     *
     * @return fulfilled with the first provider
     */
    Promise<ServiceRecord> connect(Need need, Connection connection);

    /** Stops everything that was started here, in reverse order. */
    @Override
    void close();

    /** Hears whom to use. */
    interface Connection {
        /** From now on this one. */
        void use(ServiceRecord provider);

        /** There is none any more; {@link #use} may follow later. */
        void lost(MissingServiceException why);
    }
}
