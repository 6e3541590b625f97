using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Xml.Linq;

namespace LagSim.Build;

/// <summary>XML documentation without the members that are not public.</summary>
internal static class PublicDocs
{
    /// <summary>The documentation of the public members alone.</summary>
    /// <param name="members">All members of the assembly by their identity in documentation, and whether others can use them.</param>
    /// <param name="docs">The documentation as the compiler wrote it.</param>
    /// <exception cref="InvalidDataException">It has a member that the assembly has not, so that nothing tells whether it is public.</exception>
    internal static string Prune(IReadOnlyDictionary<string, bool> members, string docs)
    {
        XDocument document = XDocument.Parse(docs, LoadOptions.PreserveWhitespace);
        foreach (XElement member in document.Descendants("member").ToArray())
        {
            string id = member.Attribute("name")!.Value;
            if (!members.TryGetValue(id, out bool isPublic))
            {
                throw new InvalidDataException($"'{id}' is documented, and is no member of the assembly.");
            }

            if (!isPublic)
            {
                (member.PreviousNode as XText)?.Remove(); // the end of the line before
                member.Remove();
            }
        }

        return $"{document.Declaration}{document.ToString(SaveOptions.DisableFormatting)}";
    }
}
