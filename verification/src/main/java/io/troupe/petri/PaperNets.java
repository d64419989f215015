package io.troupe.petri;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/**
 * The nets of the paper's fifth section: four components and their compositions.
 *
 * <p>The figures with the nets are lost. The text names the places and transitions that melding adds; the rest is our
 * reconstruction, in two readings.
 *
 * <p><b>Source.</b> Sections 5.5 and 5.6 of the paper.
 */
public final class PaperNets {
    /** What the service does between its registration and its wait for data. */
    public enum Reading {
        /** A private step (Ts8 to place S10) comes first; every statement of the paper holds. */
        A,
        /** The service waits at once. */
        B
    }

    /** The robot's stop and the three stops that must follow it. */
    private static final List<String> STOPS = List.of("Tr7", "Tp4", "Tm4", "Ts7");

    private PaperNets() {}

    /** Requests proxies from the player, then reads sensors and sets values in a loop until it stops. */
    public static PetriNet robot() {
        return stepping("robot", "R1", "R2", "R5", "R6", "R9", "R10")
                .transition("Tr1", List.of("R1"), List.of("R2"))
                .transition("Tr2", List.of("R2"), List.of("R5"))
                .transition("Tr3", List.of("R5"), List.of("R6"))
                .transition("Tr4", List.of("R6"), List.of("R9"))
                .transition("Tr5", List.of("R9"), List.of("R5"))
                .transition("Tr6", List.of("R9"), List.of("R10"))
                .transition("Tr7", List.of("R10"), List.of("R1"))
                .build();
    }

    /** Provides proxies, accepts values, and sends them to the middleware. */
    public static PetriNet player() {
        return stepping("player", "P1", "P4", "P7")
                .transition("Tp1", List.of("P1"), List.of("P4"))
                .transition("Tp2", List.of("P4"), List.of("P7"))
                .transition("Tp3", List.of("P7"), List.of("P4"))
                .transition("Tp4", List.of("P4"), List.of("P1"))
                .build();
    }

    /** Registers services, receives data and passes it to the service. */
    public static PetriNet middleware() {
        return stepping("middleware", "M1", "M4", "M7")
                .transition("Tm1", List.of("M1"), List.of("M4"))
                .transition("Tm3", List.of("M4"), List.of("M7"))
                .transition("Tm2", List.of("M7"), List.of("M4"))
                .transition("Tm4", List.of("M4"), List.of("M1"))
                .build();
    }

    /** Registers, receives data, and follows a wall or wanders; it may stop before it waits for data. */
    public static PetriNet service(Reading reading) {
        return service(reading, "S4");
    }

    static PetriNet service(Reading reading, String stopsAt) {
        var waitsAt = reading == Reading.A ? "S10" : "S4";
        var service = stepping("service", "S1", "S4");
        if (reading == Reading.A) {
            service.place("S10").transition("Ts8", List.of("S4"), List.of("S10"));
        }
        return service.place("S7")
                .place("S8")
                .place("S9")
                .transition("Ts1", List.of("S1"), List.of("S4"))
                .transition("Ts2", List.of(waitsAt), List.of("S7"))
                .transition("Ts3", List.of("S7"), List.of("S8"))
                .transition("Ts4", List.of("S7"), List.of("S9"))
                .transition("Ts5", List.of("S8"), List.of("S4"))
                .transition("Ts6", List.of("S9"), List.of("S4"))
                .transition("Ts7", List.of(stopsAt), List.of("S1"))
                .build();
    }

    /** Robot and player: get proxies. */
    public static Meld getProxies() {
        return new Meld("Tr2", "Tp1", "Tr2''", "R3''", "Trp1''", "R4''", "P2''", "P3''", "Trp2''");
    }

    /** Robot and player: set values. */
    public static Meld setValues() {
        return new Meld("Tr4", "Tp2", "Tr4''", "R7''", "Trp3''", "R8''", "P5''", "P6''", "Trp4''");
    }

    /** Player and middleware: transmit the values. */
    public static Meld transmit() {
        return new Meld("Tp3", "Tm3", "Tp3''", "P8''", "Tpm1''", "P9''", "M5''", "M6''", "Tpm2''");
    }

    /** Service and middleware: register; the text does not name S3''. */
    public static Meld register() {
        return new Meld("Ts1", "Tm1", "Ts1''", "S2''", "Tms1''", "S3''", "M2''", "M3''", "Tms2''");
    }

    /** Middleware and service: give data. */
    public static Meld giveData() {
        return new Meld("Tm2", "Ts2", "Tm2''", "M8''", "Tms3''", "M9''", "S5''", "S6''", "Tms4''");
    }

    /** The five melds of the whole net. */
    public static List<Meld> melds() {
        return List.of(getProxies(), setValues(), transmit(), register(), giveData());
    }

    /** All four components, each of which may stop at any time. */
    public static PetriNet uncorrected(Reading reading) {
        return whole("uncorrected " + reading, service(reading));
    }

    /** The uncorrected net with every stop at a lower priority than all other transitions. */
    public static PetriNet lowPriorityStops(Reading reading) {
        var net = uncorrected(reading).toBuilder().priority("Tr6", -1);
        STOPS.forEach(stop -> net.priority(stop, -1));
        return net.build();
    }

    /**
     * All four components stop together by {@code Tstop}, once the robot is ready to stop and the others wait for their
     * next call.
     */
    public static PetriNet corrected(Reading reading) {
        var waitsAt = reading == Reading.A ? "S10" : "S4";
        return Composition.fuse(whole("corrected " + reading, service(reading, waitsAt)), "Tstop", STOPS);
    }

    /** The places of a whole net by component; the first letter of a place's name is that of its component. */
    public static Map<String, List<Place>> components(PetriNet whole) {
        var components = new LinkedHashMap<String, List<Place>>();
        for (var component : List.of("robot", "player", "middleware", "service")) {
            var letter = component.substring(0, 1).toUpperCase(Locale.ROOT);
            components.put(
                    component,
                    whole.places().stream()
                            .filter(place -> place.name().startsWith(letter))
                            .toList());
        }
        return components;
    }

    private static PetriNet whole(String name, PetriNet service) {
        return Composition.compose(name, List.of(robot(), player(), middleware(), service), melds());
    }

    /** A net with one token, which is always on one of these places, initially on {@code first}. */
    private static PetriNetBuilder stepping(String name, String first, String... others) {
        var component = PetriNet.builder(name).place(first, 1);
        List.of(others).forEach(component::place);
        return component;
    }
}
