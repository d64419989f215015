package io.troupe.services.broker;

import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Address;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Keeps the registry of services, finds them, starts them when they are needed, watches their health, and tells those
 * who use them when another takes over.
 *
 * <p><b>Threads.</b> Any thread calls; listeners run on the actor space on which they were registered.
 *
 * <p><b>Errors.</b> A need that nobody can meet is rejected with a {@link MissingServiceException}.
 *
 * <p><b>Source.</b> Paper, section 2.2.4; "in case a service is not present the system should terminate gracefully",
 * section 1.
 */
public interface Broker extends AutoCloseable {
    /**
     * Offers a service. It is started when somebody needs it. If one at that address, or with the same
     * {@code provider}, was withdrawn or replaced before, that is stopped at once when this one is needed, and this one
     * is started when it has stopped or its limit is over. Those who are connected and have no provider are connected
     * to it.
     *
     * @param capabilities may be empty
     * @return rejected with an {@link IllegalArgumentException} if something is registered at that address already
     */
    Promise<ServiceRecord> register(String service, List<String> capabilities, Address address, Provider provider);

    /**
     * Withdraws an offer: those who use it get another provider, or hear that there is none; then it is stopped. A
     * start that has not begun, since it waits for the stop of another, is not begun.
     *
     * @return fulfilled when it has stopped; rejected with a {@link ProviderException} if it does not, and with an
     *     {@link IllegalArgumentException} if nothing is registered at that address
     */
    Promise<@Nullable Void> withdraw(Address provider);

    /**
     * Puts a provider in another's place while the application runs: the new one is started, users are told, the old
     * one is stopped. It has the old one's place in the order of registration, and may have its address. The replaced
     * provider can be given its place back at any time: it is stopped and started again, as {@link #register} says.
     *
     * @return fulfilled when that is done; rejected with a {@link ProviderException} if the new one cannot be started,
     *     and then the old one stays in use; with an {@link IllegalStateException} while another one is being started
     *     in its place
     */
    Promise<ServiceRecord> replace(
            Address old, String service, List<String> capabilities, Address address, Provider provider);

    /** Everything that is registered, in the order of registration. */
    Promise<List<ServiceRecord>> registered();

    /** All who meet a need, the best first: well before suspect, then in the order of registration. Starts nothing. */
    Promise<List<ServiceRecord>> find(Need need);

    /**
     * One provider that runs: well before suspect; if none runs, the first that can be started, those that have failed
     * before at last. Who needs the same at the same time waits for the same start.
     *
     * @return rejected with a {@link MissingServiceException} that names each provider and why it does not run
     */
    Promise<ServiceRecord> require(Need need);

    /**
     * Stays connected: the listener hears of the provider to use, at first and whenever another takes its place,
     * because it has failed, was withdrawn or replaced. Ends with {@link #disconnect}, and when the actor that called
     * has stopped.
     *
     * @return fulfilled with the first provider; rejected with a {@link MissingServiceException} if there is none now;
     *     the connection stays even then, and its listener hears when there is one
     */
    Promise<ServiceRecord> connect(Need need, Connection connection);

    /**
     * Ends a connection: its listener hears nothing any more. Providers are not stopped because nobody is connected to
     * them.
     */
    Promise<@Nullable Void> disconnect(Connection connection);

    /**
     * Tells users that there is nothing any more, then stops everything that was started here, one after the other in
     * reverse order of their starts, each within its limit. From the call on, everything that could start or change
     * something is refused with an {@link IllegalStateException}; {@link #registered} and {@link #find} go on to say
     * what is known, {@link #disconnect} has nothing to do, and another shutDown answers the same.
     *
     * @return fulfilled, when that is done, with those that did not stop
     */
    Promise<List<ServiceRecord>> shutDown();

    /** Begins to {@link #shutDown}, and does not wait for its end: for that, {@code broker.shutDown().get(..)}. */
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
