package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Function;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/**
 * A parsed file with all its includes.
 *
 * @param root its properties and entities at the top level
 * @param macros the {@code define}s by name; each is the entity from which an instance starts
 */
record Document(Entity root, Map<String, Entity> macros) {
    List<Entity> entities() {
        return root.children();
    }

    /** This document with other properties and without some entities; macros are changed too. */
    Document with(Function<Property, Optional<Property>> properties, Predicate<Entity> entities) {
        var changed = new LinkedHashMap<String, Entity>();
        macros.forEach((name, macro) -> changed.put(name, changed(macro, properties, entities)));
        return new Document(changed(root, properties, entities), changed);
    }

    private static Entity changed(
            Entity entity, Function<Property, Optional<Property>> properties, Predicate<Entity> entities) {
        var kept = new LinkedHashMap<String, Property>();
        entity.properties()
                .forEach((key, property) -> properties.apply(property).ifPresent(other -> kept.put(key, other)));
        List<Entity> children = entity.children().stream()
                .filter(entities)
                .map(child -> changed(child, properties, entities))
                .toList();
        return entity.with(kept, children);
    }

    /** A document without what stands at a position, and what that was. */
    record Without(Document document, String leftOut) {}

    /**
     * This document without the properties and entities at a position, of which a macro may have several; null if there
     * are none. A model whose bitmap is at that position is left out whole: it would be a box of its size.
     */
    @Nullable
    Without without(SourcePosition where) {
        var found = new ArrayList<String>();
        Document rest = with(
                property -> {
                    boolean here = property.where().equals(where)
                            || property.value().where().equals(where);
                    if (here) {
                        found.add('"' + property.key() + '"');
                    }
                    return here ? Optional.empty() : Optional.of(property);
                },
                entity -> {
                    Property bitmap = entity.properties().get("bitmap");
                    boolean here = entity.where().equals(where)
                            || bitmap != null
                                    && entity.type().equals("model")
                                    && bitmap.value().where().equals(where);
                    if (here) {
                        found.addFirst("this " + entity.type());
                    }
                    return !here;
                });
        return found.isEmpty() ? null : new Without(rest, found.getFirst());
    }
}
