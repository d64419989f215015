package io.troupe.broker;

import io.troupe.bus.Address;
import io.troupe.common.text.Suggestions;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;
import java.util.function.Predicate;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** The registry: all providers in the order of registration. Used on the broker's space. */
final class ProviderRegistry {
    private static final int MOST_LISTED = 20; // in an error message

    private final List<ManagedProvider> all = new ArrayList<>();
    private final Set<ManagedProvider> leaving = new LinkedHashSet<>(); // withdrawn or replaced, and not stopped yet
    private final Set<Address> reserved = new HashSet<>(); // for replacements that are being started

    private @Nullable String node; // of this process, if its providers are offered to others
    private Sharing sharing = Sharing.defaults();

    /** Providers of other processes may be among them from now on. */
    void share(String ownNode, Sharing how) {
        node = ownNode;
        sharing = how;
    }

    /** The providers of this process. */
    List<ManagedProvider> local() {
        return all.stream()
                .filter(each -> each.offered() == null && each.address.node().equals(node))
                .toList();
    }

    Optional<ManagedProvider> of(OfferedProvider provider) {
        return all.stream().filter(each -> each.offered() == provider).findFirst();
    }

    void add(ManagedProvider registration) {
        checkFree(registration.address, null);
        all.add(registration);
    }

    void checkFree(Address address, @Nullable Address butFor) {
        if (!address.equals(butFor) && !isFree(address)) {
            String who = at(address)
                    .map(other -> "the service \"" + other.service + "\"")
                    .orElse("another");
            throw new IllegalArgumentException(
                    "the address " + address + " is taken by " + who + ", expected a free one");
        }
    }

    boolean isFree(Address address) {
        return at(address).isEmpty() && !reserved.contains(address);
    }

    void reserve(ManagedProvider registration) {
        reserved.add(registration.address);
    }

    void free(Address address) {
        reserved.remove(address);
    }

    /**
     * Puts a provider in the position of the old one, or at the end if that was removed. The old one may run until
     * {@link #forget} is called.
     */
    void put(ManagedProvider registration, ManagedProvider old) {
        int place = all.indexOf(old);
        if (place >= 0) {
            all.set(place, registration);
            leaving.add(old);
        } else {
            all.add(registration);
        }
    }

    /** Removes a provider that does not run, and has never run or has been stopped. */
    void drop(ManagedProvider registration) {
        registration.cancelTimers();
        all.remove(registration);
    }

    /** Removes a withdrawn provider. It may run until {@link #forget} is called. */
    void remove(ManagedProvider registration) {
        all.remove(registration);
        leaving.add(registration);
    }

    void forget(ManagedProvider registration) {
        leaving.remove(registration);
    }

    /**
     * Withdrawn or replaced providers that may still run and have the same address or the same provider object. They
     * must stop before the given one is started.
     */
    List<ManagedProvider> predecessors(ManagedProvider registration) {
        return leaving.stream()
                .filter(each -> each.address.equals(registration.address) || each.hasProviderOf(registration))
                .toList();
    }

    boolean has(ManagedProvider registration) {
        return all.contains(registration);
    }

    Optional<ManagedProvider> at(Address address) {
        return all.stream().filter(each -> each.address.equals(address)).findFirst();
    }

    ManagedProvider known(Address address) {
        return at(address)
                .orElseThrow(() -> new IllegalArgumentException("nothing is registered at " + address + "; registered: "
                        + listed(all, ManagedProvider::toString)));
    }

    List<ServiceRecord> records() {
        return all.stream().map(ManagedProvider::toRecord).toList();
    }

    List<ManagedProvider> meeting(Need need) {
        return all.stream()
                .filter(each -> each.meets(need))
                .sorted(order()) // a stable sort keeps the order of registration
                .toList();
    }

    private Comparator<ManagedProvider> order() {
        var byHealth = Comparator.comparingInt(ManagedProvider::rank);
        return node == null
                ? byHealth
                : byHealth.thenComparingInt(each -> each.configuredRank(sharing))
                        .thenComparing(each -> each.address.node()); // the same in every process
    }

    Optional<ManagedProvider> best(Need need, Predicate<ManagedProvider> eligible) {
        return meeting(need).stream().filter(eligible).findFirst();
    }

    /**
     * The error for a need that no provider can meet.
     *
     * @param tried the providers that could not be started, with the reason
     */
    MissingServiceException missing(Need need, Map<ManagedProvider, Throwable> tried) {
        var text = new StringBuilder("\"" + need.by() + "\" needs " + what(need));
        List<ManagedProvider> offers = meeting(need);
        if (offers.isEmpty() && tried.isEmpty()) {
            text.append(", which no provider offers");
            similar(need)
                    .ifPresent(name ->
                            text.append("; did you mean \"").append(name).append("\"?"));
            text.append(text.charAt(text.length() - 1) == '?' ? " registered: " : "; registered: ");
        } else {
            List<ManagedProvider> these = Stream.concat(tried.keySet().stream(), offers.stream())
                    .distinct()
                    .toList();
            String why = listed(these, each -> each + " (" + reason(each, tried.get(each)) + ")");
            text.append(", which is offered, but runs nowhere: ").append(why).append("; registered: ");
        }
        text.append(all.isEmpty() ? "nothing" : listed(all, this::show));
        var missing = new MissingServiceException(need, Reasons.oneLine(text.toString()));
        tried.values().stream().limit(MOST_LISTED).forEach(missing::addSuppressed);
        return missing;
    }

    /** The first of them, and the number of others. */
    private static String listed(List<ManagedProvider> some, Function<ManagedProvider, String> words) {
        String first = some.stream().limit(MOST_LISTED).map(words).collect(Collectors.joining(", "));
        return some.size() <= MOST_LISTED ? first : first + " and " + (some.size() - MOST_LISTED) + " more";
    }

    private static String reason(ManagedProvider registration, @Nullable Throwable tried) {
        Throwable why = tried != null ? tried : registration.why();
        return why == null ? words(registration.health()) : Reasons.of(why);
    }

    /** The error for a need while the broker is shutting down. */
    static MissingServiceException closing(Need need) {
        return new MissingServiceException(
                need,
                Reasons.oneLine("\"" + need.by() + "\" needs " + what(need) + ", and the broker is being closed"));
    }

    static String what(Need need) {
        if (need.service() == null) {
            return "the capability \"" + need.capability() + "\"";
        }
        return "the service \"" + need.service() + "\""
                + (need.capability() == null ? "" : " with the capability \"" + need.capability() + "\"");
    }

    private Optional<String> similar(Need need) {
        List<String> services = all.stream().map(each -> each.service).toList();
        if (need.service() != null && !services.contains(need.service())) {
            return Suggestions.nearest(need.service(), services);
        }
        String capability = need.capability();
        return capability == null
                ? Optional.empty()
                : Suggestions.nearest(
                        capability,
                        all.stream()
                                .filter(each -> need.service() == null || each.service.equals(need.service()))
                                .flatMap(each -> each.capabilities.stream())
                                .toList());
    }

    private String show(ManagedProvider registration) {
        String capabilities =
                registration.capabilities.isEmpty() ? "" : String.join(", ", registration.capabilities) + "; ";
        String place = node == null ? "" : " at " + registration.address.node();
        return registration.service + place + " (" + capabilities + words(registration.health()) + ")";
    }

    private static String words(Health health) {
        return health.name().toLowerCase(Locale.ROOT).replace('_', ' ');
    }
}
