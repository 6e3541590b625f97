using System.IO;
using LagSim.Cli.Output;
using LagSim.Net.Protection;

namespace LagSim.Cli.Commands;

/// <summary>A file that keeps a host's identity between runs of <c>lagsim host</c>.</summary>
internal static class IdentityFile
{
    /// <summary>Reads the identity; draws one and keeps it if the file does not exist yet.</summary>
    /// <exception cref="InputException">The file holds something else.</exception>
    /// <exception cref="IOException">The file cannot be read, or not be written.</exception>
    internal static HostIdentity ReadOrDraw(string file)
    {
        if (SecretFile.Read(file) is string text)
        {
            return HostIdentity.TryParse(text, out HostIdentity? kept)
                ? kept!
                : throw new InputException($"--identity is '{file}', which holds no host's identity: 64 hexadecimal digits.");
        }

        SecretFile.ThrowIfNotWritable("--identity", file, "an identity");
        HostIdentity drawn = HostIdentity.Draw();
        SecretFile.Write(file, drawn.ToSecretText());
        return drawn;
    }
}
