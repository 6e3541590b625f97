using System;
using LagSim.Scenes;

namespace LagSim.Events;

/// <summary>Which peer may do what, if the scene limits it. A host uses it to validate events; a world by itself knows no rights.</summary>
public static class EventRights
{
    /// <summary>
    /// Whether the peer that did this may do it: spawn at all, or touch that body of the scene. Spawned bodies may be touched by all.
    /// </summary>
    public static bool Has(in ExternalEvent external, Scene scene)
    {
        if (scene is null)
        {
            throw new ArgumentNullException(nameof(scene));
        }

        return external.Kind == EventKind.Spawn ? scene.Spawners.Contains(external.Peer)
            : !TryFind(external.Body, scene, out SceneBody body) || body.Players.Contains(external.Peer);
    }

    /// <summary>Throws if the peer that did this may not do it.</summary>
    /// <exception cref="SceneException">The message names the peer, its action, and the peers that may do it.</exception>
    public static void Throw(in ExternalEvent external, Scene scene)
    {
        if (Has(external, scene))
        {
            return;
        }

        throw new SceneException(TryFind(external.Body, scene, out SceneBody body) && external.Kind != EventKind.Spawn
            ? $"Peer {external.Peer} may not touch body '{body.Name}'; those who may: {body.Players}."
            : $"Peer {external.Peer} may not spawn bodies in scene '{scene.Name}'; those who may: {scene.Spawners}.");
    }

    private static bool TryFind(BodyId id, Scene scene, out SceneBody body)
    {
        bool isOfScene = id.Peer == 0 && id.Sequence == 0 && id.Index < scene.BodyArray.Length;
        body = isOfScene ? scene.BodyArray[id.Index] : default;
        return isOfScene;
    }
}
