package io.troupe.petri;

import io.troupe.drawing.Xml;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;

/** Writes one net as PNML, line by line. */
final class PnmlWriter {
    private final PetriNet net;
    private final StringBuilder text = new StringBuilder();
    private final Set<String> taken = new HashSet<>();
    private final Map<String, String> ids = new HashMap<>();
    private int arcs;

    PnmlWriter(PetriNet net) {
        this.net = net;
    }

    String write() {
        line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
        line("<pnml xmlns=\"" + Pnml.NAMESPACE + "\">");
        line("  <net id=\"" + newId(net.name()) + "\" type=\""
                + (net.hasInhibitors() ? Pnml.INHIBITOR_NET_TYPE : Pnml.NET_TYPE) + "\">");
        line("    " + label("name", net.name()));
        line("    <page id=\"" + newId("page") + "\">");
        net.places()
                .forEach(place -> node(
                        "place",
                        place.name(),
                        place.tokens() == 0 ? "" : label("initialMarking", String.valueOf(place.tokens()))));
        net.transitions().forEach(t -> node("transition", t.name(), t.priority() == 0 ? "" : priority(t)));
        for (var transition : net.transitions()) {
            transition.inputs().forEach(arc -> arc(arc.place().name(), transition.name(), arc.weight()));
            transition
                    .outputs()
                    .forEach(arc -> arc(transition.name(), arc.place().name(), arc.weight()));
            transition.inhibitors().forEach(arc -> inhibitor(arc.place().name(), transition.name(), arc.weight()));
        }
        line("    </page>");
        line("  </net>");
        line("</pnml>");
        return text.toString();
    }

    private void node(String kind, String name, String more) {
        var id = newId(name);
        ids.put(name, id);
        line("      <" + kind + " id=\"" + id + "\">" + label("name", name) + more + "</" + kind + ">");
    }

    private static String priority(Transition transition) {
        return "<toolspecific tool=\"" + Pnml.TOOL + "\" version=\"1\"><priority>" + transition.priority()
                + "</priority></toolspecific>";
    }

    private void arc(String from, String to, int weight) {
        var head = arcHead(from, to);
        line(weight == 1 ? head + "/>" : head + ">" + label("inscription", String.valueOf(weight)) + "</arc>");
    }

    private void inhibitor(String from, String to, int weight) {
        line(arcHead(from, to) + " type=\"inhibitor\">"
                + (weight == 1 ? "" : label("inscription", String.valueOf(weight)))
                + "<type value=\"inhibitor\"/>" + label("arctype", "inhibitor") + "</arc>");
    }

    private String arcHead(String from, String to) {
        return "      <arc id=\"" + newId("a" + ++arcs) + "\" source=\"" + ids.get(from) + "\" target=\"" + ids.get(to)
                + "\"";
    }

    private void line(String line) {
        text.append(line).append('\n');
    }

    private static String label(String element, String value) {
        return "<" + element + "><text>" + Xml.escape(value) + "</text></" + element + ">";
    }

    /** A valid XML id that is as close to the name as possible. */
    private String newId(String name) {
        var id = new StringBuilder(name.replaceAll("[^A-Za-z0-9_.-]", "_"));
        if (!Character.isLetter(id.charAt(0))) {
            id.insert(0, '_');
        }
        while (!taken.add(id.toString())) {
            id.append('_');
        }
        return id.toString();
    }
}
