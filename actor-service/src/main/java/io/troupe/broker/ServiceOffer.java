package io.troupe.broker;

import java.time.Duration;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A provider that a process offers to others, as {@link ActorServices#offers} finds it.
 *
 * {@snippet :
 * services.offers(Duration.ofMillis(500))
 *         .then(offers -> offers.forEach(offer -> show(offer.provider() + ", life " + offer.life())));
 * }
 *
 * @param provider its service, capabilities, address and health, as its own process reports them; suspect if that
 *     process did not answer in time
 * @param rank the lower, the earlier it is chosen among equals
 * @param life counts the starts of the provider; 0 = it has never been started
 * @param age the time since its process published the offer
 * @param roundTrip the time of a request to the broker of its process; zero for the own process; null if there was no
 *     answer in time
 */
public record ServiceOffer(
        ServiceRecord provider,
        int rank,
        long life,
        Duration age,
        @Nullable Duration roundTrip) {
    public ServiceOffer {
        Objects.requireNonNull(provider, "provider");
        Objects.requireNonNull(age, "age");
    }
}
