using System;

namespace LagSim.Scenes;

/// <summary>A scene, or a value that would enter the world, is not valid. The message names the value and what is allowed.</summary>
public sealed class SceneException : Exception
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public SceneException()
    {
    }

    /// <summary>A sentence that names the value and what is allowed.</summary>
    public SceneException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public SceneException(string message, Exception innerException)
        : base(message, innerException)
    {
    }
}
